/// How the keys of the cable divide it; for this folder only.
#ifndef BT_CABLE_MESH_H
#define BT_CABLE_MESH_H

#include "cable/cable.h"

/// Where the wire supports stand: pairs at +-first, then every `spacing`, none nearer than half of
/// it to a sheave.
void bt_cable_place_supports(const bt_cable_params* params, bt_list* y_m);

/// Segments that the mesh makes for one half of the span, middle first; `length_m` may be NULL.
int bt_cable_mesh_half(const bt_cable_mesh_params* mesh, double half_span_m, double* length_m);

#endif

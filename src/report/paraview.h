/// A recorded landing for ParaView: a .pvd collection that names one .vtp file per part and time.
///
/// x.pvd, and in the folder x beside it: deck.vtp, airframe_NNNN.vtp, cable_NNNN.vtp. All are VTK
/// XML PolyData in ASCII, in metres, deck frame (x forward, y to port, z up; the cable rests at
/// x = 0). Cells of the airframe carry `part` (0 fuselage, 1 to 3 legs, 4 to 6 wheels, 7 hook) and
/// `cable_force_N`, the force of the cable on the hook (0 elsewhere); points of the cable carry
/// `tension_N` and `curvature_per_m`.
#ifndef BT_REPORT_PARAVIEW_H
#define BT_REPORT_PARAVIEW_H

#include "report/playback.h"

enum { BT_PARAVIEW_ROWS = 120 };

/// Writes the collection at `path`, which ends in ".pvd". A file that Bolter did not write stays.
///
/// @return BT_OK; BT_ERR_IO (said in diag); BT_ERR_INPUT (the model cannot be assembled, said in
///         diag); BT_ERR_MEMORY (also when memory ran out while observing)
BT_CHECKED bt_status bt_paraview_write(const char* path, const bt_playback* playback,
                                       const bt_model_params* model, bt_diag* diag);

#endif

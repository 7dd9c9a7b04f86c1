/// The airframe as polygons and lines that move with its bodies. Private to the ParaView writer.
#ifndef BT_REPORT_PARAVIEW_SOLID_H
#define BT_REPORT_PARAVIEW_SOLID_H

#include "landing/airframe.h"

enum {
    BT_SOLID_POINTS_MAX = 1024,
    BT_SOLID_CELLS_MAX = 1024,
    BT_SOLID_CORNERS_MAX = 8192,
};

/// Cells of one kind: polygons or lines.
typedef struct bt_cells {
    int count, corner_count;
    int part[BT_SOLID_CELLS_MAX]; ///< bt_body
    int end[BT_SOLID_CELLS_MAX];  ///< corners up to here
    int corner[BT_SOLID_CORNERS_MAX];
} bt_cells;

typedef struct bt_solid {
    int point_count;
    double local[BT_SOLID_POINTS_MAX][3]; ///< in the frame of its body
    int body[BT_SOLID_POINTS_MAX];
    bt_cells lines, polygons;
} bt_solid;

/// Fuselage (a sketch), legs, wheels and hook, from the model's dimensions.
void bt_solid_build(bt_solid* solid, const bt_airframe* airframe, double hook_length_m);

#endif

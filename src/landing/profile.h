/// The hook's head: its outline in the plane of symmetry, made of lines and arcs, extruded over
/// its width.
///
/// Frame: origin at the centre of the shoe arc; u along the shank toward the pivot, w normal to it,
/// up-and-aft (the body frame of the hook, whose y axis is the normal of the plane). The mouth
/// opens forward and down: the cable comes in from -w. The throat is all that lies inside the
/// mouth: the throat arc, and the arm's face up to the point opposite the lip.
///
///            arm back  ______________________________  u ->
///     shoe arc       (                                    (pivot)
///   (radius about   (    throat ,---------------------  arm face
///    the origin)     (_        (
///                      `--. lip `-
///                          `-'
#ifndef BT_LANDING_PROFILE_H
#define BT_LANDING_PROFILE_H

#include "landing/params.h"

typedef enum bt_zone {
    BT_ZONE_SHOE,
    BT_ZONE_POINT,
    BT_ZONE_THROAT,
    BT_ZONE_ARM,
    BT_ZONE_COUNT
} bt_zone;

const char* bt_zone_name(bt_zone zone);

/// One piece of the outline. An arc runs counterclockwise from `from` to `to` (angles, rad);
/// convex when the solid lies inside the circle. A line runs from start to end, `normal` outward.
typedef struct bt_piece {
    bt_zone zone;
    bool arc, convex;
    double centre[2], radius, from, to;
    double start[2], end[2], normal[2];
} bt_piece;

enum { BT_PIECE_COUNT = 8 };

typedef struct bt_profile {
    bt_piece pieces[BT_PIECE_COUNT];
    double lip[2];    ///< centre of the lip's rounding
    double throat[2]; ///< centre of the throat arc
    double lip_radius, shoe_radius, arm_radius, half_width;
} bt_profile;

/// Builds the outline from its dimensions.
///
/// @param arm_length_m    how far the arm reaches from the origin (to the pivot)
/// @param cable_radius_m  the cable that is to be caught
/// @param path            for messages ("aircraft.hook.profile")
/// @return BT_OK, or BT_ERR_INPUT with the reason and the value that would do in diag: no common
///         tangents, a throat that breaks through the shoe, a mouth or throat too narrow.
BT_CHECKED bt_status bt_profile_build(const bt_hook_profile_params* params, double arm_length_m,
                                      double cable_radius_m, const char* path, bt_profile* profile,
                                      bt_diag* diag);

/// The point of the outline nearest to (u, w).
typedef struct bt_nearest {
    double distance_m; ///< from the outline, negative inside the solid
    double normal[2];  ///< outward at the nearest point
    bt_zone zone;
} bt_nearest;

bt_nearest bt_profile_nearest(const bt_profile* profile, double u_m, double w_m);

#endif

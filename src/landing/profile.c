#include "landing/profile.h"

#include <math.h>

static const double two_pi = 6.283185307179586;

/// A millimetre of steel: the least the throat may leave above the shoe.
static const double floor_least_m = 1e-3;

const char* bt_zone_name(bt_zone zone) {
    static const char* const names[] = {"shoe", "point", "throat", "arm"};
    return names[zone];
}

static bt_piece arc(bt_zone zone, bool convex, const double centre[2], double radius, double from,
                    double to) {
    return (bt_piece){.zone = zone,
                      .arc = true,
                      .convex = convex,
                      .centre = {centre[0], centre[1]},
                      .radius = radius,
                      .from = from,
                      .to = to};
}

static bt_piece line(bt_zone zone, double u0, double w0, double u1, double w1, const double n[2]) {
    return (bt_piece){.zone = zone, .start = {u0, w0}, .end = {u1, w1}, .normal = {n[0], n[1]}};
}

/// Refuses dimensions that give no outline, each with the value that would do.
static bt_status check_dimensions(const bt_hook_profile_params* p, const double lip[2],
                                  double cable_radius_m, const char* path, bt_diag* diag) {
    const double gap = -lip[1] - p->lip_radius_m - p->arm_radius_m;
    const double lip_out = hypot(lip[0], lip[1]) + p->lip_radius_m;
    bt_status status = BT_OK;
    if (p->throat_radius_m < cable_radius_m) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.throat_radius: %g mm is less than the cable's radius; the throat holds it "
                    "from %g mm on",
                    path, 1e3 * p->throat_radius_m, 1e3 * cable_radius_m);
        status = BT_ERR_INPUT;
    }
    if (gap < 2 * cable_radius_m) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.point_ahead: the mouth between lip and arm is %g mm wide, the cable %g mm "
                    "thick; move the lip %g mm further from the arm",
                    path, 1e3 * gap, 2e3 * cable_radius_m, 1e3 * (2 * cable_radius_m - gap));
        status = BT_ERR_INPUT;
    }
    if (lip_out < p->shoe_radius_m) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.lip_radius: the lip lies inside the shoe arc, so that no outline leads "
                    "around it; %g mm or more would do",
                    path, 1e3 * (p->lip_radius_m + p->shoe_radius_m - lip_out));
        status = BT_ERR_INPUT;
    }
    return status;
}

/// The throat breaks through the shoe: says so, with the longest straight that would do, if any.
static void refuse_crossing(const bt_hook_profile_params* p, const double lip[2], double floor_m,
                            const char* path, bt_diag* diag) {
    const double radii = p->lip_radius_m + p->throat_radius_m;
    const double w = -(p->arm_radius_m + p->throat_radius_m), across = lip[1] - w;
    const double reach = p->shoe_radius_m - p->throat_radius_m - floor_least_m;
    const double along = reach > fabs(w) ? lip[0] + sqrt(reach * reach - w * w) : -1;
    const double most2 = along * along - radii * radii + across * across;
    if (along > 0 && most2 >= 0 && most2 < p->throat_length_m * p->throat_length_m &&
        across * across - radii * radii <= most2)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.throat_length: the outline crosses itself: at %g mm the throat leaves %g "
                    "mm above the shoe, at least %g mm are needed; %.4g mm or less would do",
                    path, 1e3 * p->throat_length_m, 1e3 * floor_m, 1e3 * floor_least_m,
                    1e3 * sqrt(most2));
    else
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.shoe_radius: the outline crosses itself: the throat leaves %g mm above the "
                    "shoe, at least %g mm are needed; a shoe %.4g mm larger with the lip as it is, "
                    "or a smaller throat_radius, would do",
                    path, 1e3 * floor_m, 1e3 * floor_least_m, 1e3 * (floor_least_m - floor_m));
}

/// Centre of the throat arc: tangent to the arm face, and joined to the lip by a straight of the
/// given length that is tangent to both.
static bt_status place_throat(const bt_hook_profile_params* p, const double lip[2],
                              const char* path, double throat[2], bt_diag* diag) {
    const double radii = p->lip_radius_m + p->throat_radius_m;
    throat[1] = -(p->arm_radius_m + p->throat_radius_m);
    const double across = lip[1] - throat[1];
    const double along2 = radii * radii + p->throat_length_m * p->throat_length_m - across * across;
    if (!(along2 >= 0)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.throat_length: %g mm is too short to join lip and throat; %g mm or more "
                    "would do",
                    path, 1e3 * p->throat_length_m, 1e3 * sqrt(across * across - radii * radii));
        return BT_ERR_INPUT;
    }
    throat[0] = lip[0] - sqrt(along2);
    const double floor_m = p->shoe_radius_m - hypot(throat[0], throat[1]) - p->throat_radius_m;
    if (floor_m < floor_least_m) {
        refuse_crossing(p, lip, floor_m, path, diag);
        return BT_ERR_INPUT;
    }
    return BT_OK;
}

bt_status bt_profile_build(const bt_hook_profile_params* p, double arm_length_m,
                           double cable_radius_m, const char* path, bt_profile* profile,
                           bt_diag* diag) {
    // the lip is given with the shoe level; turn it into the frame of the shank
    const double c = cos(p->head_angle_rad), s = sin(p->head_angle_rad);
    const double ahead = p->point_ahead_m, up = p->lip_height_m - p->shoe_radius_m;
    const double lip[2] = {ahead * c + up * s, -ahead * s + up * c};
    const double origin[2] = {0, 0};
    const double shoe = p->shoe_radius_m, r_lip = p->lip_radius_m, r_arm = p->arm_radius_m;
    double throat[2];

    BT_TRY(check_dimensions(p, lip, cable_radius_m, path, diag));
    BT_TRY(place_throat(p, lip, path, throat, diag));
    if (shoe <= r_arm) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.arm_radius: %g mm is not less than shoe_radius (%g mm)", path, 1e3 * r_arm,
                    1e3 * shoe);
        return BT_ERR_INPUT;
    }

    // outer tangent of shoe and lip: both circles on the same side of it
    const double lip_distance = hypot(lip[0], lip[1]);
    double lip_angle = atan2(lip[1], lip[0]);
    if (lip_angle < 0)
        lip_angle += two_pi;
    const double tangent = lip_angle - acos((shoe - r_lip) / lip_distance);
    const double m[2] = {cos(tangent), sin(tangent)};

    // inner tangent of lip and throat: solid on one side, void on the other
    const double d[2] = {lip[0] - throat[0], lip[1] - throat[1]};
    const double d_angle = atan2(d[1], d[0]), d_length = hypot(d[0], d[1]);
    const double swing = acos(-(r_lip + p->throat_radius_m) / d_length);
    double inner = d_angle + swing;
    while (inner < tangent)
        inner += two_pi;
    while (inner >= tangent + two_pi)
        inner -= two_pi;
    const double n[2] = {cos(inner), sin(inner)};
    const double r_throat = p->throat_radius_m;
    const double back = asin(r_arm / shoe);
    static const double up_normal[2] = {0, 1}, down_normal[2] = {0, -1};

    *profile = (bt_profile){
        .pieces = {arc(BT_ZONE_SHOE, true, origin, shoe, back, tangent),
                   line(BT_ZONE_POINT, shoe * m[0], shoe * m[1], lip[0] + r_lip * m[0],
                        lip[1] + r_lip * m[1], m),
                   arc(BT_ZONE_POINT, true, lip, r_lip, tangent, inner),
                   line(BT_ZONE_POINT, lip[0] + r_lip * n[0], lip[1] + r_lip * n[1],
                        throat[0] - r_throat * n[0], throat[1] - r_throat * n[1], n),
                   arc(BT_ZONE_THROAT, false, throat, r_throat, two_pi / 4, inner - two_pi / 2),
                   line(BT_ZONE_THROAT, throat[0], -r_arm, lip[0], -r_arm, down_normal),
                   line(BT_ZONE_ARM, lip[0], -r_arm, arm_length_m, -r_arm, down_normal),
                   line(BT_ZONE_ARM, arm_length_m, r_arm, shoe * cos(back), r_arm, up_normal)},
        .lip = {lip[0], lip[1]},
        .throat = {throat[0], throat[1]},
        .lip_radius = r_lip,
        .shoe_radius = shoe,
        .arm_radius = r_arm,
        .half_width = 0.5 * p->width_m,
    };
    return BT_OK;
}

/// Nearest point of one arc. Off its ends the neighbour is nearer, so those return infinity.
static bt_nearest nearest_on_arc(const bt_piece* a, double u, double w) {
    const double du = u - a->centre[0], dw = w - a->centre[1];
    const double r = hypot(du, dw);
    double angle = atan2(dw, du);
    while (angle < a->from)
        angle += two_pi;
    if (angle > a->to || r == 0)
        return (bt_nearest){.distance_m = INFINITY};
    const double sign = a->convex ? 1 : -1;
    return (bt_nearest){.distance_m = sign * (r - a->radius),
                        .normal = {sign * du / r, sign * dw / r},
                        .zone = a->zone};
}

static bt_nearest nearest_on_line(const bt_piece* l, double u, double w) {
    const double tu = l->end[0] - l->start[0], tw = l->end[1] - l->start[1];
    const double along = (u - l->start[0]) * tu + (w - l->start[1]) * tw;
    if (along < 0 || along > tu * tu + tw * tw)
        return (bt_nearest){.distance_m = INFINITY};
    return (bt_nearest){.distance_m =
                            (u - l->start[0]) * l->normal[0] + (w - l->start[1]) * l->normal[1],
                        .normal = {l->normal[0], l->normal[1]},
                        .zone = l->zone};
}

bt_nearest bt_profile_nearest(const bt_profile* profile, double u, double w) {
    bt_nearest best = {.distance_m = INFINITY};
    for (int i = 0; i < BT_PIECE_COUNT; ++i) {
        const bt_piece* piece = &profile->pieces[i];
        const bt_nearest near =
            piece->arc ? nearest_on_arc(piece, u, w) : nearest_on_line(piece, u, w);
        if (fabs(near.distance_m) < fabs(best.distance_m))
            best = near;
    }
    return best;
}

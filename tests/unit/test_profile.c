#include "reference.h"

#include "landing/profile.h"

#include <stdlib.h>

static const double pi = 3.14159265358979323846;
static const double cable_radius_m = 0.01825, arm_length_m = 2.352;

static bt_hook_profile_params usual(void) {
    bt_hook_profile_params p;
    bt_group_set_defaults(&bt_hook_profile_group, &p);
    return p;
}

static bt_profile built(const bt_hook_profile_params* p) {
    bt_profile profile;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_profile_build(p, arm_length_m, cable_radius_m, "hook", &profile, &diag) != BT_OK)
        fail_msg("refused: %s", kept.text);
    return profile;
}

/// Point and outward normal of a piece at a fraction of it, in the direction of the outline: shoe,
/// point, throat, arm. The throat, being hollow, is run through clockwise.
static void walk(const bt_piece* piece, double fraction, double point[2], double normal[2]) {
    if (!piece->arc) {
        for (int k = 0; k < 2; ++k) {
            point[k] = piece->start[k] + fraction * (piece->end[k] - piece->start[k]);
            normal[k] = piece->normal[k];
        }
        return;
    }
    double to = piece->to;
    while (to < piece->from)
        to += 2 * pi;
    const double along = piece->convex ? fraction : 1 - fraction;
    const double angle = piece->from + along * (to - piece->from);
    const double sign = piece->convex ? 1 : -1;
    normal[0] = sign * cos(angle);
    normal[1] = sign * sin(angle);
    point[0] = piece->centre[0] + piece->radius * cos(angle);
    point[1] = piece->centre[1] + piece->radius * sin(angle);
}

/// Heads from small to large, with the lip near the shoe and far from it.
static int some_profiles(bt_hook_profile_params* p) {
    int count = 0;
    for (int k = 0; k < 4; ++k)
        p[k] = usual();
    count = 4;
    p[1].lip_height_m = 0.022;
    p[2].lip_height_m = 0.034;
    p[2].point_ahead_m = 0.058;
    p[2].lip_radius_m = 0.012;
    p[2].head_angle_rad = 1.0;
    p[3].throat_radius_m = 0.022;
    p[3].throat_length_m = 0.030;
    p[3].shoe_radius_m = 0.090;
    p[3].lip_radius_m = 0.014;
    p[3].point_ahead_m = 0.060;
    return count;
}

static void the_outline_is_closed_and_smooth_but_for_the_corner_behind(void** state) {
    (void)state;
    bt_hook_profile_params p[4];
    const int count = some_profiles(p);
    for (int k = 0; k < count; ++k) {
        const bt_profile profile = built(&p[k]);
        for (int i = 0; i < BT_PIECE_COUNT; ++i) {
            double end[2], start[2], n[2], m[2];
            walk(&profile.pieces[i], 1, end, n);
            walk(&profile.pieces[(i + 1) % BT_PIECE_COUNT], 0, start, m);
            if (i == BT_PIECE_COUNT - 2) { // the arm runs on to the pivot
                BT_ASSERT_NEAR(end[0], arm_length_m, 1e-15, 0);
                BT_ASSERT_NEAR(start[0], arm_length_m, 1e-15, 0);
                continue;
            }
            BT_ASSERT_NEAR(hypot(end[0] - start[0], end[1] - start[1]), 0, 0, 1e-15);
            if (i < BT_PIECE_COUNT - 2)
                BT_ASSERT_NEAR(n[0] * m[0] + n[1] * m[1], 1, 0, 1e-15);
            BT_ASSERT_NEAR(hypot(n[0], n[1]), 1, 0, 1e-15);
        }
    }
}

static void the_lip_lies_where_the_drawing_says_with_the_shoe_level(void** state) {
    (void)state;
    const bt_hook_profile_params p = usual();
    const bt_profile profile = built(&p);
    // u is along the shank: with the shank head_angle below the horizontal it points forward and up
    const double c = cos(p.head_angle_rad), s = sin(p.head_angle_rad);
    const double ahead = profile.lip[0] * c - profile.lip[1] * s;
    const double up = profile.lip[0] * s + profile.lip[1] * c;
    BT_ASSERT_NEAR(ahead, p.point_ahead_m, 1e-14, 0);
    BT_ASSERT_NEAR(up + p.shoe_radius_m, p.lip_height_m, 1e-13, 0);
}

static void the_throat_holds_the_cable_and_the_mouth_lets_it_in(void** state) {
    (void)state;
    bt_hook_profile_params p[4];
    const int count = some_profiles(p);
    for (int k = 0; k < count; ++k) {
        const bt_profile profile = built(&p[k]);
        // a cable at the throat's centre has room; one that is carried home touches the throat
        const bt_nearest home =
            bt_profile_nearest(&profile, profile.throat[0] - 1e-6, profile.throat[1]);
        assert_int_equal(home.zone, BT_ZONE_THROAT);
        BT_ASSERT_NEAR(home.distance_m, p[k].throat_radius_m - 1e-6, 1e-9, 0);
        const double mouth = -profile.lip[1] - profile.lip_radius - profile.arm_radius;
        assert_true(mouth >= 2 * cable_radius_m);
    }
}

/// A closed polygon along the outline (the arm's end closed by a straight), for brute force.
enum { PER_PIECE = 4000, POLYGON = BT_PIECE_COUNT * PER_PIECE };

static void sample(const bt_profile* profile, double polygon[][2], bt_zone* zone) {
    for (int i = 0; i < BT_PIECE_COUNT; ++i)
        for (int k = 0; k < PER_PIECE; ++k) {
            double normal[2];
            walk(&profile->pieces[i], (k + 0.5) / PER_PIECE, polygon[i * PER_PIECE + k], normal);
            zone[i * PER_PIECE + k] = profile->pieces[i].zone;
        }
}

static bool inside(double polygon[][2], double u, double w) {
    bool in = false;
    for (int i = 0, j = POLYGON - 1; i < POLYGON; j = i++)
        if ((polygon[i][1] > w) != (polygon[j][1] > w) &&
            u < polygon[i][0] + (w - polygon[i][1]) * (polygon[j][0] - polygon[i][0]) /
                                    (polygon[j][1] - polygon[i][1]))
            in = !in;
    return in;
}

/// The nearest point by brute force, for every place that the cable's centre can take: outside, and
/// inside as deep as a contact may press it.
static void nearest_agrees_with_a_thousand_samples(void** state) {
    (void)state;
    bt_hook_profile_params p[4];
    const int count = some_profiles(p);
    double(*polygon)[2] = calloc(POLYGON, sizeof *polygon);
    bt_zone* zone = calloc(POLYGON, sizeof *zone);
    for (int k = 0; k < count; ++k) {
        bt_profile profile = built(&p[k]);
        // a short arm, so that the samples lie densely on it
        profile.pieces[BT_PIECE_COUNT - 2].end[0] = 0.4;
        profile.pieces[BT_PIECE_COUNT - 1].start[0] = 0.4;
        sample(&profile, polygon, zone);
        for (double u = -0.12; u <= 0.25; u += 0.0137)
            for (double w = -0.16; w <= 0.12; w += 0.0119) {
                double best = INFINITY;
                int at = 0;
                for (int i = 0; i < POLYGON; ++i) {
                    const double d = hypot(polygon[i][0] - u, polygon[i][1] - w);
                    if (d < best) {
                        best = d;
                        at = i;
                    }
                }
                const bool in = inside(polygon, u, w);
                // the corner behind has no normal of its own; no cable gets inside it
                const double corner =
                    hypot(polygon[at][0] - profile.pieces[BT_PIECE_COUNT - 1].end[0],
                          polygon[at][1] - profile.pieces[BT_PIECE_COUNT - 1].end[1]);
                if (in && (best > 0.01 || corner < 3e-4))
                    continue;
                const bt_nearest near = bt_profile_nearest(&profile, u, w);
                // samples lie at most 0.15 mm apart: too far by (spacing / 2)^2 / (2 distance)
                const double off = fmin(5e-5, 3e-9 / best);
                BT_ASSERT_NEAR(near.distance_m, in ? -best : best, 0, off);
                if (fabs(best - 0) > 1e-4)
                    assert_int_equal(near.zone, zone[at]);
                BT_ASSERT_NEAR(hypot(near.normal[0], near.normal[1]), 1, 0, 1e-14);
                // the normal is the way out: a step along it changes the distance by the step
                const double step = 1e-7;
                const bt_nearest further = bt_profile_nearest(&profile, u + step * near.normal[0],
                                                              w + step * near.normal[1]);
                BT_ASSERT_NEAR(further.distance_m - near.distance_m, step, 1e-6, 0);
            }
    }
    free(zone);
    free(polygon);
}

/// Refuses the head and gives the text; afterwards the head with the advice taken must pass.
static void refuse(const bt_hook_profile_params* p, const char* reason, messages* kept) {
    bt_profile profile;
    *kept = (messages){""};
    bt_diag diag = {.sink = keep_message, .user = kept};
    assert_int_equal(bt_profile_build(p, arm_length_m, cable_radius_m, "hook", &profile, &diag),
                     BT_ERR_INPUT);
    if (!strstr(kept->text, reason))
        fail_msg("\"%s\" does not say \"%s\"", kept->text, reason);
}

/// The number that follows `before` in a text.
static double number_after(const char* text, const char* before) {
    const char* found = strstr(text, before);
    if (!found)
        fail_msg("\"%s\" does not say \"%s\"", text, before);
    return strtod(found + strlen(before), NULL);
}

static void a_mouth_too_narrow_is_refused_with_the_way_to_widen_it(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.arm_radius_m = 0.026;
    messages kept;
    refuse(&p, "hook.point_ahead", &kept);
    const double further_m = 1e-3 * number_after(kept.text, "move the lip ");
    assert_true(further_m > 0);
    p.point_ahead_m += 1.0001 * further_m / sin(p.head_angle_rad);
    built(&p);
}

static void a_lip_inside_the_shoe_is_refused_with_the_radius_that_would_do(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.lip_radius_m = 0.005;
    messages kept;
    refuse(&p, "hook.lip_radius", &kept);
    p.lip_radius_m = 1e-3 * number_after(kept.text, "around it; ") * 1.00001;
    built(&p);
}

static void
a_throat_narrower_than_the_cable_is_refused_with_the_radius_that_would_do(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.throat_radius_m = 0.015;
    messages kept;
    refuse(&p, "hook.throat_radius", &kept);
    p.throat_radius_m = 1e-3 * number_after(kept.text, "holds it from ");
    built(&p);
}

static void a_throat_that_breaks_through_the_shoe_is_refused(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.throat_length_m = 0.06;
    messages kept;
    refuse(&p, "crosses itself", &kept);
    const double left = 1e-3 * number_after(kept.text, "the throat leaves ");
    const double needed = 1e-3 * number_after(kept.text, "at least ");
    assert_true(left < needed);
    p.shoe_radius_m += 2 * (needed - left);
    p.lip_height_m += 2 * (needed - left); // the lip stays where it is
    p.lip_radius_m += 2 * (needed - left);
    bt_profile profile;
    // either it passes, or something else is named: the floor is no longer what is wrong
    kept = (messages){""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_profile_build(&p, arm_length_m, cable_radius_m, "hook", &profile, &diag) != BT_OK)
        assert_null(strstr(kept.text, "crosses itself"));
}

static void a_throat_too_long_is_refused_with_the_length_that_would_do(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.throat_length_m = 0.06;
    messages kept;
    refuse(&p, "hook.throat_length: the outline crosses itself", &kept);
    const double most = 1e-3 * number_after(kept.text, "are needed; ");
    p.throat_length_m = 0.9999 * most;
    built(&p);
    p.throat_length_m = 1.001 * most;
    refuse(&p, "crosses itself", &kept);
}

static void
a_throat_too_short_to_reach_the_arm_is_refused_with_the_length_that_would_do(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.lip_height_m = 0.005;
    p.point_ahead_m = 0.11;
    p.throat_length_m = 0;
    messages kept;
    refuse(&p, "hook.throat_length", &kept);
    const double enough = 1e-3 * number_after(kept.text, "lip and throat; ");
    assert_true(enough > 0);
    p.throat_length_m = 1.00001 * enough;
    bt_profile profile;
    kept = (messages){""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_profile_build(&p, arm_length_m, cable_radius_m, "hook", &profile, &diag) != BT_OK)
        assert_null(strstr(kept.text, "throat_length"));
}

static void an_arm_thicker_than_the_shoe_is_refused(void** state) {
    (void)state;
    bt_hook_profile_params p = usual();
    p.shoe_radius_m = 0.03;
    p.arm_radius_m = 0.035;
    p.lip_height_m = 0.0;
    p.point_ahead_m = 0.12;
    p.throat_length_m = 0.06;
    bt_profile profile;
    assert_int_equal(bt_profile_build(&p, arm_length_m, cable_radius_m, "hook", &profile, NULL),
                     BT_ERR_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_outline_is_closed_and_smooth_but_for_the_corner_behind),
        cmocka_unit_test(the_lip_lies_where_the_drawing_says_with_the_shoe_level),
        cmocka_unit_test(the_throat_holds_the_cable_and_the_mouth_lets_it_in),
        cmocka_unit_test(nearest_agrees_with_a_thousand_samples),
        cmocka_unit_test(a_mouth_too_narrow_is_refused_with_the_way_to_widen_it),
        cmocka_unit_test(a_lip_inside_the_shoe_is_refused_with_the_radius_that_would_do),
        cmocka_unit_test(a_throat_narrower_than_the_cable_is_refused_with_the_radius_that_would_do),
        cmocka_unit_test(a_throat_that_breaks_through_the_shoe_is_refused),
        cmocka_unit_test(a_throat_too_long_is_refused_with_the_length_that_would_do),
        cmocka_unit_test(
            a_throat_too_short_to_reach_the_arm_is_refused_with_the_length_that_would_do),
        cmocka_unit_test(an_arm_thicker_than_the_shoe_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#include "elements/strut.h"

#include "mechanics/vec.h"

/// Stroke and its rate; the axis in the world and the point both forces act at.
static double stroke(const bt_element* element, const bt_motion* motion, double axis[3],
                     double point[3], double* rate) {
    const bt_strut* s = element->data;
    double root[3], velocity_a[3], velocity_b[3], offset[3], arm[3], turn[3];
    bt_point_position(motion, element->body_a, s->point_a_m, root);
    bt_point_position(motion, element->body_b, s->point_b_m, point);
    bt_point_velocity(motion, element->body_a, s->point_a_m, velocity_a);
    bt_point_velocity(motion, element->body_b, s->point_b_m, velocity_b);
    if (element->body_a == BT_GROUND) {
        for (int i = 0; i < 3; ++i) {
            axis[i] = s->axis_a[i];
            turn[i] = 0;
        }
    } else {
        const double* rotation = motion->rotation + 9 * element->body_a;
        bt_rotate(rotation, s->axis_a, axis);
        bt_cross(motion->v + 6 * element->body_a + 3, s->axis_a, arm);
        bt_rotate(rotation, arm, turn);
    }
    double stroke_m = 0, rate_mps = 0;
    for (int i = 0; i < 3; ++i) {
        offset[i] = point[i] - root[i];
        stroke_m += axis[i] * offset[i];
        rate_mps += axis[i] * (velocity_b[i] - velocity_a[i]) + turn[i] * offset[i];
    }
    *rate = rate_mps;
    return stroke_m;
}

static void strut_force(const bt_element* element, const bt_motion* motion, double* wrench,
                        double* output) {
    const bt_strut* s = element->data;
    double axis[3], point[3], rate, on_a[3], on_b[3];
    const double stroke_m = stroke(element, motion, axis, point, &rate);
    const double force = bt_oleo_force(&s->oleo, stroke_m, rate);
    for (int i = 0; i < 3; ++i) {
        on_a[i] = force * axis[i];
        on_b[i] = -on_a[i];
    }
    bt_wrench_add(motion, element->body_a, point, on_a, wrench);
    bt_wrench_add(motion, element->body_b, point, on_b, wrench);
    output[BT_STRUT_STROKE] = stroke_m;
    output[BT_STRUT_RATE] = rate;
    output[BT_STRUT_FORCE] = force;
}

static double strut_energy(const bt_element* element, const bt_motion* motion) {
    const bt_strut* s = element->data;
    double axis[3], point[3], rate;
    return bt_oleo_energy(&s->oleo, stroke(element, motion, axis, point, &rate));
}

static bt_law strut_law(const bt_element* element, const double* output, const char** what) {
    const bt_strut* s = element->data;
    return bt_oleo_law(&s->oleo, output[BT_STRUT_STROKE], what);
}

static const char* const output_names[] = {"stroke_m", "rate_mps", "force_N"};

const bt_element_type bt_strut_type = {
    .name = "strut",
    .data_size = sizeof(bt_strut),
    .output_count = BT_STRUT_OUTPUTS,
    .output_names = output_names,
    .force = strut_force,
    .energy = strut_energy,
    .law = strut_law,
};

/* ---- held by a pin at each end ---- */

static double link_stroke(const bt_element* element, const bt_motion* motion, bt_link* link) {
    const bt_strut_link* s = element->data;
    bt_link_between(motion, element->body_a, s->point_a_m, element->body_b, s->point_b_m, link);
    return s->length_m - link->distance_m;
}

static void link_force(const bt_element* element, const bt_motion* motion, double* wrench,
                       double* output) {
    const bt_strut_link* s = element->data;
    bt_link link;
    const double stroke_m = link_stroke(element, motion, &link);
    const double force = bt_oleo_force(&s->oleo, stroke_m, link.closing_mps);
    bt_link_push(motion, element->body_a, element->body_b, &link, force, wrench);
    output[BT_STRUT_STROKE] = stroke_m;
    output[BT_STRUT_RATE] = link.closing_mps;
    output[BT_STRUT_FORCE] = force;
}

static double link_energy(const bt_element* element, const bt_motion* motion) {
    const bt_strut_link* s = element->data;
    bt_link link;
    return bt_oleo_energy(&s->oleo, link_stroke(element, motion, &link));
}

static bt_law link_law(const bt_element* element, const double* output, const char** what) {
    const bt_strut_link* s = element->data;
    return bt_oleo_law(&s->oleo, output[BT_STRUT_STROKE], what);
}

const bt_element_type bt_strut_link_type = {
    .name = "strut_link",
    .data_size = sizeof(bt_strut_link),
    .output_count = BT_STRUT_OUTPUTS,
    .output_names = output_names,
    .force = link_force,
    .energy = link_energy,
    .law = link_law,
};

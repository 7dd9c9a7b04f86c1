#include "elements/spring.h"

#include "mechanics/vec.h"

/// Ends and length of the line; unit from a to b (zero when the points coincide).
static double line(const bt_element* element, const bt_motion* motion, double a[3], double b[3],
                   double unit[3]) {
    const bt_spring* spring = element->data;
    bt_point_position(motion, element->body_a, spring->point_a_m, a);
    bt_point_position(motion, element->body_b, spring->point_b_m, b);
    for (int i = 0; i < 3; ++i)
        unit[i] = b[i] - a[i];
    const double length = bt_norm(unit);
    for (int i = 0; i < 3; ++i)
        unit[i] = length > 0 ? unit[i] / length : 0;
    return length;
}

static void spring_force(const bt_element* element, const bt_motion* motion, double* wrench,
                         double* output) {
    const bt_spring* spring = element->data;
    double a[3], b[3], unit[3], va[3], vb[3];
    const double length = line(element, motion, a, b, unit);
    bt_point_velocity(motion, element->body_a, spring->point_a_m, va);
    bt_point_velocity(motion, element->body_b, spring->point_b_m, vb);
    const double rate = bt_dot(unit, vb) - bt_dot(unit, va);
    const double force =
        spring->stiffness_Npm * (length - spring->free_length_m) + spring->damping_Nspm * rate;
    const double on_a[3] = {force * unit[0], force * unit[1], force * unit[2]};
    const double on_b[3] = {-on_a[0], -on_a[1], -on_a[2]};
    bt_wrench_add(motion, element->body_a, a, on_a, wrench);
    bt_wrench_add(motion, element->body_b, b, on_b, wrench);
    output[BT_SPRING_LENGTH] = length;
    output[BT_SPRING_FORCE] = force;
}

static double spring_energy(const bt_element* element, const bt_motion* motion) {
    const bt_spring* spring = element->data;
    double a[3], b[3], unit[3];
    const double extension = line(element, motion, a, b, unit) - spring->free_length_m;
    return 0.5 * spring->stiffness_Npm * extension * extension;
}

static const char* const outputs[] = {"length_m", "force_N"};

const bt_element_type bt_spring_element = {
    .name = "spring",
    .data_size = sizeof(bt_spring),
    .output_count = BT_SPRING_OUTPUT_COUNT,
    .output_names = outputs,
    .force = spring_force,
    .energy = spring_energy,
};

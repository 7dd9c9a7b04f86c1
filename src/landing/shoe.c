#include "landing/shoe.h"

#include "mechanics/vec.h"

/// Lowest point of a disc of the given radius about `centre`, in the hook's plane of symmetry.
static void lowest_of_disc(const double centre[3], double radius_m, const double side[3],
                           double lowest[3]) {
    // the downward direction within the plane whose normal is `side`
    const double upright = sqrt(1 - side[2] * side[2]);
    const double down[3] = {side[2] * side[0] / upright, side[2] * side[1] / upright, -upright};
    for (int i = 0; i < 3; ++i)
        lowest[i] = centre[i] + radius_m * down[i];
}

void bt_shoe_lowest(const bt_shoe* shoe, const bt_motion* motion, int hook, double lowest_m[3]) {
    const double* a = motion->rotation + 9 * hook;
    const double side[3] = {a[1], a[4], a[7]};
    double centre[3], lip[3];
    bt_point_position(motion, hook, shoe->shoe_m, centre);
    lowest_of_disc(centre, shoe->shoe_radius_m, side, lowest_m);
    bt_point_position(motion, hook, shoe->lip_m, centre);
    lowest_of_disc(centre, shoe->lip_radius_m, side, lip);
    if (lip[2] < lowest_m[2])
        for (int i = 0; i < 3; ++i)
            lowest_m[i] = lip[i];
}

static void force(const bt_element* element, const bt_motion* motion, double* wrench,
                  double* output) {
    const bt_shoe* shoe = element->data;
    const int hook = element->body_a;
    double point[3];
    bt_shoe_lowest(shoe, motion, hook, point);

    // velocity of the material point of the hook that is lowest
    const double* q = motion->q + 7 * hook;
    const double arm[3] = {point[0] - q[0], point[1] - q[1], point[2] - q[2]};
    double local[3], velocity[3], push[3];
    bt_unrotate(motion->rotation + 9 * hook, arm, local);
    bt_point_velocity(motion, hook, local, velocity);
    output[BT_SHOE_HEIGHT] = point[2];
    output[BT_SHOE_RATE] = velocity[2];
    output[BT_SHOE_FORCE] = 0;
    output[BT_SHOE_X] = point[0];
    if (!(point[2] < 0))
        return;
    const double normal = bt_impact_force(&shoe->impact, -point[2], -velocity[2]);
    velocity[2] = 0;
    bt_impact_friction(&shoe->impact, normal, velocity, push);
    push[2] = normal;
    bt_wrench_add(motion, hook, point, push, wrench);
    output[BT_SHOE_FORCE] = normal;
}

static double energy(const bt_element* element, const bt_motion* motion) {
    const bt_shoe* shoe = element->data;
    double point[3];
    bt_shoe_lowest(shoe, motion, element->body_a, point);
    return point[2] < 0 ? bt_impact_energy(&shoe->impact, -point[2]) : 0;
}

static bt_law law(const bt_element* element, const double* output, const char** what) {
    const bt_shoe* shoe = element->data;
    if (!(output[BT_SHOE_HEIGHT] < -shoe->shoe_radius_m))
        return BT_LAW_HOLDS;
    *what = "shoe below the deck";
    return BT_LAW_LEFT;
}

static const char* const output_names[] = {"height_m", "rate_mps", "force_N", "x_m"};

const bt_element_type bt_shoe_type = {
    .name = "shoe",
    .data_size = sizeof(bt_shoe),
    .output_count = BT_SHOE_OUTPUTS,
    .output_names = output_names,
    .force = force,
    .energy = energy,
    .law = law,
};

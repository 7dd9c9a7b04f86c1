#include "elements/hook_damper_element.h"

#include "mechanics/vec.h"

static double stroke(const bt_element* element, const bt_motion* motion, bt_link* link) {
    const bt_hook_damper_mount* m = element->data;
    bt_link_between(motion, element->body_a, m->point_a_m, element->body_b, m->point_b_m, link);
    return m->length_m - link->distance_m;
}

static void damper_force(const bt_element* element, const bt_motion* motion, double* wrench,
                         double* output) {
    const bt_hook_damper_mount* m = element->data;
    bt_link link;
    const double stroke_m = stroke(element, motion, &link);
    const double force = bt_hook_damper_force(&m->damper, stroke_m, link.closing_mps);
    bt_link_push(motion, element->body_a, element->body_b, &link, force, wrench);
    output[BT_HOOK_DAMPER_STROKE] = stroke_m;
    output[BT_HOOK_DAMPER_RATE] = link.closing_mps;
    output[BT_HOOK_DAMPER_FORCE] = force;
}

static double damper_energy(const bt_element* element, const bt_motion* motion) {
    const bt_hook_damper_mount* m = element->data;
    bt_link link;
    return bt_hook_damper_energy(&m->damper, stroke(element, motion, &link));
}

static bt_law damper_law(const bt_element* element, const double* output, const char** what) {
    const bt_hook_damper_mount* m = element->data;
    return bt_hook_damper_law(&m->damper, output[BT_HOOK_DAMPER_STROKE], what);
}

static const char* const output_names[] = {"stroke_m", "rate_mps", "force_N"};

const bt_element_type bt_hook_damper_element = {
    .name = "hook_damper",
    .data_size = sizeof(bt_hook_damper_mount),
    .output_count = BT_HOOK_DAMPER_OUTPUTS,
    .output_names = output_names,
    .force = damper_force,
    .energy = damper_energy,
    .law = damper_law,
};

void bt_hook_damper_place(double down_stop_rad, double lever_m, double angle_rad, double length_m,
                          double on_shank[3], double on_fuselage[3]) {
    const double c = cos(down_stop_rad), s = sin(down_stop_rad);
    const double along[3] = {-c, 0, -s}, rising[3] = {-s, 0, c};
    for (int i = 0; i < 3; ++i) {
        on_shank[i] = lever_m * along[i];
        on_fuselage[i] =
            on_shank[i] + length_m * (sin(angle_rad) * rising[i] - cos(angle_rad) * along[i]);
    }
}

/// Moment about the pivot that lowers the hook, at rest at a shank angle.
static double lowering_moment(const bt_hook_damper* damper, const double on_fuselage[3],
                              double lever_m, double length_m, double shank_rad) {
    const double end[2] = {-lever_m * cos(shank_rad), -lever_m * sin(shank_rad)};
    const double push[2] = {end[0] - on_fuselage[0], end[1] - on_fuselage[2]};
    const double distance = sqrt(push[0] * push[0] + push[1] * push[1]);
    const double stroke_m = length_m - distance;
    const double arm = (end[0] * push[1] - end[1] * push[0]) / distance;
    return bt_hook_damper_force(damper, stroke_m, 0) * arm;
}

double bt_hook_damper_hanging_angle(const bt_hook_damper* damper, double down_stop_rad,
                                    double lever_m, double angle_rad, double length_m,
                                    double weight_moment_Nm, double pitch_rad) {
    double on_shank[3], on_fuselage[3];
    bt_hook_damper_place(down_stop_rad, lever_m, angle_rad, length_m, on_shank, on_fuselage);
    double low = down_stop_rad, high = down_stop_rad + 0.3;
    for (int i = 0; i < 60; ++i) {
        const double shank = 0.5 * (low + high);
        const double moment = lowering_moment(damper, on_fuselage, lever_m, length_m, shank) +
                              weight_moment_Nm * cos(shank + pitch_rad);
        if (moment > 0)
            low = shank;
        else
            high = shank;
    }
    return 0.5 * (low + high);
}

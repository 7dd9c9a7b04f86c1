#include "elements/hook_damper_element.h"
#include "elements/yaw_damper.h"
#include "landing/profile.h"
#include "landing/shoe.h"
#include "mechanics/vec.h"
#include "rigs/rig.h"

#include <string.h>

enum { BODY_CARRIAGE, BODY_BASKET, BODY_HOOK };

/// Heavy enough that friction at the disc does not slow the rim: its momentum is that of hundreds
/// of impacts.
static const double carriage_kg = 1e7;

/// A bounce is a rise above this height; less is chatter of one contact.
static const double chatter_m = 1e-4;

/// Spring and damper under the basket, on at first contact; they only push.
typedef struct buffer {
    double stiffness_Npm, damping_Npmps, height_m;
} buffer;

enum { BUFFER_FORCE, BUFFER_OUTPUTS };

static void buffer_force(const bt_element* element, const bt_motion* motion, double* wrench,
                         double* output) {
    const buffer* b = element->data;
    const int basket = element->body_a;
    const double depth = b->height_m - motion->q[7 * basket + 2];
    output[BUFFER_FORCE] = 0;
    if (!(depth > 0))
        return;
    const double push = b->stiffness_Npm * depth - b->damping_Npmps * motion->v[6 * basket + 2];
    output[BUFFER_FORCE] = fmax(push, 0);
    wrench[6 * basket + 2] += output[BUFFER_FORCE];
}

static double buffer_energy(const bt_element* element, const bt_motion* motion) {
    const buffer* b = element->data;
    const double depth = b->height_m - motion->q[7 * element->body_a + 2];
    return depth > 0 ? 0.5 * b->stiffness_Npm * depth * depth : 0;
}

static const char* const buffer_names[] = {"force_N"};

static const bt_element_type buffer_type = {
    .name = "buffer",
    .data_size = sizeof(buffer),
    .output_count = BUFFER_OUTPUTS,
    .output_names = buffer_names,
    .force = buffer_force,
    .energy = buffer_energy,
};

typedef struct rebound_rig {
    bt_rig rig;
    bt_shoe shoe_contact;
    int shoe, damper, buffer;
    double lift_N;
    double start_x_m; ///< place of the head's lowest point
} rebound_rig;

/// K of two Hertz springs in series: (K_1^-2/3 + K_2^-2/3)^-3/2, the approaches add up.
static double in_series(double first, double second) {
    return pow(pow(first, -2.0 / 3) + pow(second, -2.0 / 3), -1.5);
}

static bt_status describe_shoe(const bt_hook_params* hook, const bt_rebound_params* p,
                               rebound_rig* r) {
    bt_profile profile;
    // No cable here; the outline alone is wanted.
    BT_TRY(bt_profile_build(&hook->profile, hook->length_m, 0.5 * hook->profile.throat_radius_m,
                            "hook.profile", &profile, r->rig.diag));
    const double shoe_x = hook->mass_centre_m - hook->length_m;
    r->shoe_contact = (bt_shoe){.shoe_m = {shoe_x, 0, 0},
                                .shoe_radius_m = profile.shoe_radius,
                                .lip_radius_m = profile.lip_radius,
                                .lip_m = {shoe_x + profile.lip[0], 0, profile.lip[1]}};
    bt_impact* impact = &r->shoe_contact.impact;
    bt_impact_prepare(&hook->deck_contact, impact);
    if (p->coating_stiffness_Npm15 > 0)
        impact->stiffness = in_series(impact->stiffness, p->coating_stiffness_Npm15);
    return BT_OK;
}

/// Turned about y: shank (or basket) lowered by an angle.
static void turned_down(double angle_rad, double e[4]) {
    e[0] = cos(0.5 * angle_rad);
    e[1] = e[3] = 0;
    e[2] = -sin(0.5 * angle_rad);
}

/// The hook's body with its pivot at the origin.
static bt_body_def hook_body(const bt_hook_params* h, double shank_rad) {
    const double about_centre = h->inertia_kgm2 - h->mass_kg * h->mass_centre_m * h->mass_centre_m;
    bt_body_def body = {
        .name = "hook",
        .mass_kg = h->mass_kg,
        .inertia_kgm2 = {h->axial_inertia_kgm2, about_centre, about_centre},
        .position_m = {-h->mass_centre_m * cos(shank_rad), 0, -h->mass_centre_m * sin(shank_rad)},
    };
    turned_down(shank_rad, body.attitude);
    return body;
}

/// Lowest point of the head when the hook's body stands as described.
static void lowest_point(const bt_shoe* shoe, const bt_body_def* body, double lowest[3]) {
    double q[7], rotation[9];
    memcpy(q, body->position_m, sizeof body->position_m);
    memcpy(q + 3, body->attitude, sizeof body->attitude);
    bt_rotation_from_euler(body->attitude, rotation);
    const bt_motion motion = {.q = q, .rotation = rotation};
    bt_shoe_lowest(shoe, &motion, 0, lowest);
}

/// Carriage, basket at the pivot, hook; the head touches the disc.
static void add_bodies(const bt_hook_params* hook, const bt_rebound_params* p, double shank_rad,
                       rebound_rig* r, double* pivot_height_m) {
    bt_body_def head = hook_body(hook, shank_rad + p->pitch_rad);
    double lowest[3];
    lowest_point(&r->shoe_contact, &head, lowest);
    *pivot_height_m = -lowest[2];
    r->start_x_m = lowest[0];
    head.position_m[2] += *pivot_height_m;
    const double m = p->basket_mass_kg;
    bt_body_def bodies[] = {
        {.name = "carriage",
         .mass_kg = carriage_kg,
         .inertia_kgm2 = {carriage_kg, carriage_kg, carriage_kg},
         .attitude = {1, 0, 0, 0}},
        {.name = "basket",
         .mass_kg = m,
         .inertia_kgm2 = {m, m, m},
         .position_m = {0, 0, *pivot_height_m}},
        head,
    };
    turned_down(p->pitch_rad, bodies[BODY_BASKET].attitude);
    for (int i = 0; i < 3; ++i) {
        bodies[i].velocity_mps[0] = p->rim_speed_mps;
        bodies[i].velocity_mps[2] = i == BODY_CARRIAGE ? 0 : -p->sink_speed_mps;
        bt_rig_add_body(&r->rig, &bodies[i]);
    }
}

static void add_joints(const bt_hook_params* hook, const bt_rebound_params* p,
                       double pivot_height_m, bt_system* system) {
    const bt_joint_def rim = {.name = "rim",
                              .kind = BT_JOINT_PRISMATIC,
                              .body_a = BT_GROUND,
                              .body_b = BODY_CARRIAGE,
                              .axis_a = {1, 0, 0},
                              .axis_b = {1, 0, 0},
                              .attitude_ab = {1, 0, 0, 0}};
    bt_joint_def guides = {.name = "guides",
                           .kind = BT_JOINT_PRISMATIC,
                           .body_a = BODY_CARRIAGE,
                           .body_b = BODY_BASKET,
                           .point_a_m = {0, 0, pivot_height_m},
                           .axis_a = {0, 0, 1},
                           .axis_b = {sin(p->pitch_rad), 0, cos(p->pitch_rad)}};
    turned_down(p->pitch_rad, guides.attitude_ab);
    const bt_joint_def pivot = {.name = "hook_pivot",
                                .kind = BT_JOINT_UNIVERSAL,
                                .body_a = BODY_BASKET,
                                .body_b = BODY_HOOK,
                                .point_b_m = {hook->mass_centre_m, 0, 0},
                                .axis_a = {0, 1, 0},
                                .axis_b = {0, 0, 1}};
    bt_system_add_joint(system, &rim);
    bt_system_add_joint(system, &guides);
    bt_system_add_joint(system, &pivot);
}

static int add_element(bt_system* system, const bt_element_type* type, const char* name, int a,
                       int b, const void* data) {
    return bt_system_add_element(
        system, &(bt_element){.type = type, .name = name, .body_a = a, .body_b = b, .data = data});
}

static void add_elements(const bt_hook_params* hook, const bt_hook_damper* damper,
                         const bt_rebound_params* p, double pivot_height_m, rebound_rig* r) {
    bt_system* system = r->rig.system;
    double on_shank[3];
    bt_hook_damper_mount mount = {.damper = *damper,
                                  .point_b_m = {hook->mass_centre_m - hook->damper_lever_m, 0, 0},
                                  .length_m = hook->damper_length_m};
    bt_hook_damper_place(hook->down_stop_rad, hook->damper_lever_m, hook->damper_angle_rad,
                         hook->damper_length_m, on_shank, mount.point_a_m);
    const bt_yaw_damper yaw = {.axis_a = {0, 1, 0},
                               .axis_b = {0, 0, 1},
                               .neutral_b = {0, 1, 0},
                               .stiffness_Nmprad = hook->centring_stiffness_Nmprad,
                               .damping_Nmsprad = hook->centring_damping_Nmsprad};
    const buffer under = {p->buffer_stiffness_Npm, p->buffer_damping_Npmps, pivot_height_m};
    r->damper =
        add_element(system, &bt_hook_damper_element, "hook_damper", BODY_BASKET, BODY_HOOK, &mount);
    add_element(system, &bt_yaw_damper_element, "yaw_damper", BODY_BASKET, BODY_HOOK, &yaw);
    r->shoe =
        add_element(system, &bt_shoe_type, "hook_shoe", BODY_HOOK, BT_GROUND, &r->shoe_contact);
    r->buffer = add_element(system, &buffer_type, "buffer", BODY_BASKET, BT_GROUND, &under);
}

static bt_status build(const bt_hook_params* hook, const bt_rebound_params* p, rebound_rig* r) {
    BT_TRY(describe_shoe(hook, p, r));
    bt_hook_damper damper;
    bt_hook_damper_prepare(&hook->damper, &damper);
    const double effective_mps2 = p->lift_ratio * p->gravity_mps2;
    const double shank = bt_hook_damper_hanging_angle(
        &damper, hook->down_stop_rad, hook->damper_lever_m, hook->damper_angle_rad,
        hook->damper_length_m, hook->mass_kg * effective_mps2 * hook->mass_centre_m, p->pitch_rad);
    double pivot_height;
    add_bodies(hook, p, shank, r, &pivot_height);
    add_joints(hook, p, pivot_height, r->rig.system);
    add_elements(hook, &damper, p, pivot_height, r);
    r->lift_N = effective_mps2 * (p->basket_mass_kg + hook->mass_kg);
    return bt_rig_start(&r->rig, p->gravity_mps2);
}

enum { HEIGHT, FORCE, X, DAMPER_STROKE, DAMPER_FORCE, BASKET };

const char* const bt_rebound_channels[BT_REBOUND_CHANNELS] = {"hook_height_m",  "hook_force_N",
                                                              "hook_x_m",       "damper_stroke_m",
                                                              "damper_force_N", "basket_sinkage_m"};

static void look(const rebound_rig* r, double basket_start_m, double channel[BT_REBOUND_CHANNELS]) {
    const double* shoe = bt_rig_output(&r->rig, r->shoe);
    const double* damper = bt_rig_output(&r->rig, r->damper);
    channel[HEIGHT] = shoe[BT_SHOE_HEIGHT];
    channel[FORCE] = shoe[BT_SHOE_FORCE];
    channel[X] = shoe[BT_SHOE_X] - r->start_x_m;
    channel[DAMPER_STROKE] = damper[BT_HOOK_DAMPER_STROKE];
    channel[DAMPER_FORCE] = damper[BT_HOOK_DAMPER_FORCE];
    channel[BASKET] = basket_start_m - r->rig.state.q[7 * BODY_BASKET + 2];
}

/// The first bounce: from the first impact to the second.
typedef struct bounce {
    bool airborne, complete;
    double impact_N, height_m, damper_m;
    double rebound_mps; ///< rise of the head's lowest point where it left the disc
    double last_height_m, last_rate_mps, from_x_m, to_x_m;
} bounce;

/// Speed where the height was zero, between two states of which only the first is below it.
static double leaving_speed(const bounce* b, double height_m, double rate_mps) {
    const double share = -b->last_height_m / (height_m - b->last_height_m);
    return b->last_rate_mps + share * (rate_mps - b->last_rate_mps);
}

static void follow(bounce* b, double rate_mps, const double channel[BT_REBOUND_CHANNELS]) {
    b->damper_m = fmax(b->damper_m, channel[DAMPER_STROKE]);
    const double height = channel[HEIGHT];
    if (!b->airborne && b->last_height_m < 0 && height >= 0)
        b->rebound_mps = leaving_speed(b, height, rate_mps);
    b->last_height_m = height;
    b->last_rate_mps = rate_mps;
    if (!b->airborne) {
        b->impact_N = fmax(b->impact_N, channel[FORCE]);
        b->airborne = channel[HEIGHT] > chatter_m;
        if (channel[FORCE] > 0)
            b->from_x_m = channel[X];
        return;
    }
    b->height_m = fmax(b->height_m, channel[HEIGHT]);
    b->to_x_m = channel[X];
    b->complete = channel[FORCE] > 0;
}

static void report(const bt_rebound_params* p, const bounce* b, const rebound_rig* r,
                   bt_rig_result* result) {
    const bt_rebound_reference_params* ref = &p->reference;
    const double height = b->complete ? b->height_m : NAN;
    const double distance = b->complete ? b->to_x_m - b->from_x_m : NAN;
    bt_rig_result_begin(&r->rig, result);
    bt_rig_add(result, "rebound_height_m", "m", height, ref->rebound_height_m, ref->tolerance);
    bt_rig_add(result, "bounce_distance_m", "m", distance, ref->bounce_distance_m, ref->tolerance);
    bt_rig_add(result, "impact_force_N", "N", b->impact_N, ref->impact_force_N, ref->tolerance);
    bt_rig_add(result, "damper_stroke_max_m", "m", b->damper_m, ref->damper_stroke_max_m,
               ref->tolerance);
    bt_rig_add(result, "restitution", "1", b->airborne ? b->rebound_mps / p->sink_speed_mps : NAN,
               0, 0);
    bt_rig_add_energy(&r->rig, result, 3, (const int[]){r->damper, r->buffer, r->shoe},
                      (const char* const[]){"damper_taken_J", "buffer_taken_J", "disc_taken_J"});
}

/// Long steps in the air, short ones at the disc and when it may be reached within two.
static double next_step(const bt_rebound_params* p, const bounce* b, double sink_mps) {
    const double reach = 2 * p->step_s * fmax(sink_mps, 0) + chatter_m;
    return b->last_height_m > reach ? p->step_s : p->contact_step_s;
}

static bt_status run_rebound(const bt_hook_params* hook, const bt_rebound_params* p, rebound_rig* r,
                             bt_rig_result* result) {
    BT_TRY(build(hook, p, r));
    r->rig.frame_mps[0] = p->rim_speed_mps;
    r->rig.state.applied[6 * BODY_BASKET + 2] = r->lift_N;
    BT_TRY(bt_rig_begin(&r->rig));
    const double basket_start = r->rig.state.q[7 * BODY_BASKET + 2];
    bounce b = {0};
    double channel[BT_REBOUND_CHANNELS];
    look(r, basket_start, channel);
    bt_rig_show(&r->rig, BT_REBOUND_CHANNELS, bt_rebound_channels, channel);
    double sink = p->sink_speed_mps;
    while (r->rig.state.time_s < p->duration_s && !b.complete) {
        const double before = channel[HEIGHT], step = next_step(p, &b, sink);
        BT_TRY(bt_rig_step(&r->rig, step));
        look(r, basket_start, channel);
        sink = (before - channel[HEIGHT]) / step;
        follow(&b, bt_rig_output(&r->rig, r->shoe)[BT_SHOE_RATE], channel);
        bt_rig_show(&r->rig, BT_REBOUND_CHANNELS, bt_rebound_channels, channel);
    }
    report(p, &b, r, result);
    return BT_OK;
}

bt_status bt_rig_run_rebound(const bt_hook_params* hook, const bt_rebound_params* rebound,
                             bt_rig_result* result, bt_rig_observer* observer, void* user,
                             bt_diag* diag) {
    rebound_rig r = {0};
    bt_status status = bt_rig_open(&r.rig, observer, user, diag);
    if (status == BT_OK)
        status = run_rebound(hook, rebound, &r, result);
    bt_rig_close(&r.rig);
    return status;
}

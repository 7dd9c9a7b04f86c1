#include "cable/slide.h"

#include "cable/cable_parts.h"
#include "cable/deck.h"
#include "elements/friction.h"
#include "mechanics/vec.h"

/// Velocities of a segment: of its centre, and angular.
typedef struct motion {
    double v[3], w[3];
} motion;

/// What an impulse and its moment about the centre add to the motion of a segment.
static void respond(const bt_cable_model* model, const bt_cable_state* s, int i,
                    const double impulse[3], const double moment[3], motion* m) {
    const double t[3] = {s->tx[i], s->ty[i], s->tz[i]};
    bt_add_scaled(m->v, model->inverse_mass[i], impulse);
    bt_add_scaled(m->w, model->inverse_tilt[i], moment);
    bt_add_scaled(m->w, model->inverse_spin[i] * bt_dot(moment, t), t);
}

/// As `respond`, of the friction of a contact during a time.
static void respond_to(const bt_cable_model* model, const bt_cable_state* s,
                       const bt_cable_slide* slide, double time_s, motion* m) {
    double impulse[3], moment[3];
    for (int k = 0; k < 3; ++k)
        impulse[k] = time_s * slide->force_N[k];
    bt_cross(slide->arm_m, impulse, moment);
    respond(model, s, slide->segment, impulse, moment, m);
}

static motion motion_now(const bt_cable_state* s, int i) {
    return (motion){.v = {s->vx[i], s->vy[i], s->vz[i]}, .w = {s->wx[i], s->wy[i], s->wz[i]}};
}

/// Motion of a segment in the middle of the coming kick, of joints, supports, deck, weight and the
/// loads set so far.
static motion in_the_middle(const bt_cable_model* model, const bt_cable_state* s, int i,
                            double kick_s) {
    const deck_law law = deck_law_of(model);
    const double tilt_rate = s->wx[i] * s->ty[i] - s->wy[i] * s->tx[i];
    const deck_push deck =
        deck_under(law, model->half_m[i], s->z[i], s->tz[i], s->vz[i], tilt_rate);
    const double sx = s->vx[i] - s->wy[i] * law.radius, sy = s->vy[i] + s->wx[i] * law.radius;
    const double drag = deck_drag(law, deck.normal, sx, sy, kick_s * model->inverse_slide[i]);
    const double half_s = 0.5 * kick_s,
                 weight = -s->scalars->frame.gravity_mps2[2] * model->mass_kg[i];
    const int j = i + 1;
    const double impulse[3] = {
        half_s * (s->joint_fx[j] - s->joint_fx[i] + s->fx[i] - drag * sx),
        half_s * (s->joint_fy[j] - s->joint_fy[i] + s->fy[i] - drag * sy),
        half_s *
            (s->joint_fz[j] - s->joint_fz[i] + s->fz[i] + s->support_fz[i] + deck.normal - weight),
    };
    const double moment[3] = {
        half_s * (s->before_x[j] + s->after_x[i] + s->mx[i] + s->support_mx[i] +
                  deck.moment * s->ty[i] - law.radius * drag * sy),
        half_s * (s->before_y[j] + s->after_y[i] + s->my[i] + law.radius * drag * sx -
                  deck.moment * s->tx[i]),
        half_s * (s->before_z[j] + s->after_z[i] + s->mz[i]),
    };
    motion m = motion_now(s, i);
    respond(model, s, i, impulse, moment, &m);
    if (!bt_cable_frame_is_still(s)) {
        double force[3], torque[3];
        bt_cable_frame_load(model, s, i, kick_s, force, torque);
        for (int k = 0; k < 3; ++k) {
            force[k] *= half_s;
            torque[k] *= half_s;
        }
        respond(model, s, i, force, torque, &m);
    }
    return m;
}

/// The tangential slip of a motion at a contact.
static void slip_of(const motion* m, const bt_cable_slide* slide, double slip[3]) {
    bt_cross(m->w, slide->arm_m, slip);
    for (int k = 0; k < 3; ++k)
        slip[k] += m->v[k] - slide->other_mps[k];
    bt_add_scaled(slip, -bt_dot(slip, slide->normal), slide->normal);
}

/// Friction at one contact; its work during the kick, J.
static double friction_kick(const bt_cable_model* model, const bt_cable_state* s, double kick_s,
                            const motion* m, bt_cable_slide* slide) {
    const int i = slide->segment;
    double slip[3];
    slip_of(m, slide, slip);
    bt_friction_force(slide->limit_N, slide->slip_speed_mps, slip, slide->force_N);
    const double size = bt_norm(slide->force_N), speed = bt_norm(slip);
    if (!(size > 0))
        return 0;
    double turning[3];
    bt_cross(slide->arm_m, slide->force_N, turning);
    const double along = s->tx[i] * turning[0] + s->ty[i] * turning[1] + s->tz[i] * turning[2];
    const double per_mass =
        model->inverse_mass[i] + (model->inverse_tilt[i] * bt_dot(turning, turning) +
                                  model->inverse_spin[i] * along * along) /
                                     (size * size);
    const double most = speed / (kick_s * per_mass);
    const double force = size < most ? size : most;
    for (int k = 0; k < 3; ++k)
        slide->force_N[k] *= force / size;
    return -kick_s * force * (speed - 0.5 * kick_s * per_mass * force);
}

double bt_cable_slides(const bt_cable_model* model, bt_cable_state* cable, double step_s,
                       bt_cable_slide* slides, int count) {
    const double kick_s = 0.5 * (cable->scalars->last_step_s + step_s);
    double work_J = 0;
    for (int n = 0; n < count; ++n) {
        bt_cable_slide* slide = &slides[n];
        const int i = slide->segment;
        slide->arm_m[0] = slide->point_m[0] - cable->x[i];
        slide->arm_m[1] = slide->point_m[1] - cable->y[i];
        slide->arm_m[2] = slide->point_m[2] - cable->z[i];
        motion m = in_the_middle(model, cable, i, kick_s);
        // of the frictions found before on this segment the whole: together they only take energy
        for (int k = 0; k < n; ++k)
            if (slides[k].segment == i)
                respond_to(model, cable, &slides[k], 0.5 * kick_s, &m);
        work_J += friction_kick(model, cable, kick_s, &m, slide);
        bt_cable_add_load(cable, i, slide->force_N, slide->point_m);
    }
    return work_J;
}

double bt_cable_slides_power(const bt_cable_state* cable, const bt_cable_slide* slides, int count) {
    double power_W = 0;
    for (int n = 0; n < count; ++n) {
        const motion m = motion_now(cable, slides[n].segment);
        double slip[3];
        slip_of(&m, &slides[n], slip);
        power_W += bt_dot(slides[n].force_N, slip);
    }
    return power_W;
}

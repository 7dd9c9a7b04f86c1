#include "mechanics/dynamics.h"
#include "mechanics/vec.h"

#include <stdlib.h>
#include <string.h>

/// E of joints that close loops, as a share of the row's own G M^-1 G^T.
#define LOOP_EPSILON 1e-10
enum { LOOP_REFINEMENTS = 2 };

/// A row counts as dependent when less than this share of it is new.
#define DEPENDENT_SHARE 1e-8

/// How far apart axis_a and axis_b of a prismatic joint may be in the given attitudes.
#define AXIS_CORRECTION_MAX_RAD 0.1

static bool finite_all(const double* x, int count) {
    for (int i = 0; i < count; ++i)
        if (!isfinite(x[i]))
            return false;
    return true;
}

static void error(bt_diag* diag, const char* what, const char* name, const char* text) {
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s '%s': %s", what, name, text);
}

/* ------------------------------------------------------------------ bodies */

/// Positive definite by Sylvester's leading minors.
static bool positive_definite(const double m[9], double tolerance) {
    const double minor2 = m[0] * m[4] - m[1] * m[3];
    const double det = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                       m[2] * (m[3] * m[7] - m[4] * m[6]);
    const double s = m[0] + m[4] + m[8];
    return m[0] > tolerance * s && m[4] > tolerance * s && m[8] > tolerance * s &&
           minor2 > tolerance * s * s && det > tolerance * s * s * s;
}

static void invert(const double m[9], double inverse[9]) {
    const double c[3] = {m[4] * m[8] - m[5] * m[7], m[5] * m[6] - m[3] * m[8],
                         m[3] * m[7] - m[4] * m[6]};
    const double s = 1 / (m[0] * c[0] + m[1] * c[1] + m[2] * c[2]);
    inverse[0] = s * c[0];
    inverse[1] = inverse[3] = s * c[1];
    inverse[2] = inverse[6] = s * c[2];
    inverse[4] = s * (m[0] * m[8] - m[2] * m[6]);
    inverse[5] = inverse[7] = s * (m[1] * m[6] - m[0] * m[7]);
    inverse[8] = s * (m[0] * m[4] - m[1] * m[3]);
}

/// The triangle inequality of the principal moments holds when tr(J)/2 - J has no negative
/// eigenvalue: it is the second moment of the mass, integral of r r^T dm. Flat bodies and rods lie
/// on the bound, so it is shifted by rounding first.
static bool triangle_inequality(const double j[9]) {
    const double trace = j[0] + j[4] + j[8];
    double second[9];
    for (int i = 0; i < 9; ++i)
        second[i] = -j[i] + (i % 4 == 0 ? trace * (0.5 + 1e-6) : 0);
    return positive_definite(second, 0);
}

static void check_body(bt_body* body, bt_diag* diag) {
    const double* g = body->given_inertia;
    if (!(body->mass_kg > 0) || !isfinite(body->mass_kg)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "body '%s': mass must be positive, not %g kg",
                    body->name, body->mass_kg);
        return;
    }
    if (!finite_all(g, 6) || !finite_all(body->q, 7) || !finite_all(body->v, 6)) {
        error(diag, "body", body->name, "inertia, position, attitude and velocity must be finite");
        return;
    }
    const double inertia[9] = {g[0], g[3], g[4], g[3], g[1], g[5], g[4], g[5], g[2]};
    memcpy(body->inertia, inertia, sizeof inertia);
    if (!positive_definite(inertia, 1e-14))
        error(diag, "body", body->name, "inertia must be positive definite");
    else if (!triangle_inequality(inertia))
        error(diag, "body", body->name,
              "no mass distribution has this inertia: a principal moment is larger than the sum "
              "of the other two");
    const double* e = body->q + 3;
    if (!(bt_dot(e, e) + e[3] * e[3] > 0)) {
        error(diag, "body", body->name, "the attitude (Euler parameters) is zero");
        return;
    }
    bt_euler_normalise(body->q + 3);
    body->inverse_mass = 1 / body->mass_kg;
    invert(inertia, body->inverse_inertia);
}

/* ------------------------------------------------------------------ joints */

static const double no_turn[4] = {1, 0, 0, 0};

static const double* attitude_of(const bt_system* system, int body) {
    return body == BT_GROUND ? no_turn : system->bodies[body].q + 3;
}

static bool unit(double axis[3]) {
    const double length = bt_norm(axis);
    if (!(length > 0))
        return false;
    for (int i = 0; i < 3; ++i)
        axis[i] /= length;
    return true;
}

/// y = A(e_ab) x: from b's frame to a's.
static void into_a(const double e_ab[4], const double x[3], double y[3]) {
    double a[9];
    bt_rotation_from_euler(e_ab, a);
    bt_rotate(a, x, y);
}

/// The relative attitude that a fixed or prismatic joint keeps, and agreement of the axes with it.
static void check_lock(const bt_system* system, bt_joint* joint, bt_diag* diag) {
    double* e = joint->attitude_ab;
    const bool given = bt_dot(e, e) + e[3] * e[3] > 0;
    if (given)
        bt_euler_normalise(e);
    else
        bt_euler_relative(attitude_of(system, joint->body_a), attitude_of(system, joint->body_b),
                          e);
    if (!bt_joint_has_axis(joint->kind) || !unit(joint->axis_b))
        return;
    double seen[3], turn[3];
    into_a(e, joint->axis_b, seen);
    const double side = bt_dot(seen, joint->axis_a) < 0 ? -1 : 1; // a line has no direction
    for (int i = 0; i < 3; ++i)
        seen[i] *= side;
    bt_cross(seen, joint->axis_a, turn);
    const double angle = atan2(bt_norm(turn), bt_dot(seen, joint->axis_a));
    if (angle > (given ? 1e-6 : AXIS_CORRECTION_MAX_RAD)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "joint '%s': its axes are not parallel: axis_b is %.3g deg away from axis_a "
                    "in the given attitude",
                    joint->name, angle * 57.29577951308232);
        return;
    }
    if (angle == 0)
        return;
    double correction[4], corrected[4];
    const double s = angle / bt_norm(turn);
    for (int i = 0; i < 3; ++i)
        turn[i] *= s;
    bt_euler_from_vector(turn, correction);
    bt_euler_multiply(correction, e, corrected);
    memcpy(e, corrected, sizeof corrected);
}

static void check_axes(const bt_system* system, bt_joint* joint, bt_diag* diag) {
    if (bt_joint_has_axis(joint->kind) && !unit(joint->axis_a)) {
        error(diag, "joint", joint->name, "axis_a is zero");
        return;
    }
    if (bt_joint_has_axis(joint->kind))
        bt_joint_sides(joint->axis_a, joint->side_a);
    if (joint->kind == BT_JOINT_UNIVERSAL && !unit(joint->axis_b))
        error(diag, "joint", joint->name, "axis_b is zero; a universal joint needs both arms");
    if (bt_joint_aligns_axes(joint->kind) && !unit(joint->axis_b)) {
        double e[4];
        bt_euler_relative(attitude_of(system, joint->body_b), attitude_of(system, joint->body_a),
                          e);
        into_a(e, joint->axis_a, joint->axis_b); // e is the attitude of a seen from b
    }
    if (bt_joint_locks(joint->kind))
        check_lock(system, joint, diag);
}

static double gyration_radius(const bt_body* body) {
    return sqrt((body->inertia[0] + body->inertia[4] + body->inertia[8]) * body->inverse_mass / 2);
}

static void set_scales(bt_system* system, bt_joint* joint) {
    double size = fmax(bt_norm(joint->point_a), bt_norm(joint->point_b));
    if (joint->body_a >= 0)
        size = fmax(size, gyration_radius(&system->bodies[joint->body_a]));
    if (joint->body_b >= 0)
        size = fmax(size, gyration_radius(&system->bodies[joint->body_b]));
    const int lengths = bt_joint_length_rows(joint->kind);
    for (int r = 0; r < BT_JOINT_ROWS_MAX; ++r)
        joint->row_scale[r] = r < lengths ? size : 1;
    system->smallest_scale = fmin(system->smallest_scale, size);
}

static void check_joint(bt_system* system, bt_joint* joint, bt_diag* diag) {
    const int n = system->body_count;
    if (!bt_joint_row_count(joint->kind)) {
        error(diag, "joint", joint->name, "no such kind of joint");
        return;
    }
    if (joint->body_a < BT_GROUND || joint->body_a >= n || joint->body_b < BT_GROUND ||
        joint->body_b >= n) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "joint '%s': connects body %d to body %d, but there are bodies 0 to %d only",
                    joint->name, joint->body_a, joint->body_b, n - 1);
        return;
    }
    if (joint->body_a == joint->body_b) {
        error(diag, "joint", joint->name, "connects a body to itself");
        return;
    }
    if (!finite_all(joint->point_a, 3) || !finite_all(joint->point_b, 3) ||
        !finite_all(joint->axis_a, 3) || !finite_all(joint->axis_b, 3) ||
        !finite_all(joint->attitude_ab, 4)) {
        error(diag, "joint", joint->name, "points, axes and attitude must be finite");
        return;
    }
    if (joint->kind == BT_JOINT_DISTANCE && !(joint->length_m > 0 && isfinite(joint->length_m))) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "joint '%s': length must be positive, not %g m",
                    joint->name, joint->length_m);
        return;
    }
    check_axes(system, joint, diag);
    set_scales(system, joint);
}

static void check_element(const bt_system* system, const bt_element* element, bt_diag* diag) {
    const int n = system->body_count;
    if (element->body_a < BT_GROUND || element->body_a >= n || element->body_b < BT_GROUND ||
        element->body_b >= n)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "element '%s': acts between body %d and body %d, but there are bodies 0 to %d "
                    "only",
                    element->name, element->body_a, element->body_b, n - 1);
}

/* ------------------------------------------------------------------ rows that depend on others */

typedef struct row_work {
    double *row, *left; ///< [m x 6n] rows in the mass metric; [m] what is left of each
    bool* used;
} row_work;

/// row := G M^-1/2 (by the Cholesky factor of the inertia), each of unit length
static void scaled_rows(const bt_system* system, const bt_work* work, double* row) {
    const int n6 = 6 * system->body_count;
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        for (int r = joint->row; r < joint->row + joint->row_count; ++r) {
            const int ends[2] = {joint->body_a, joint->body_b};
            const double* g[2] = {work->ga + 6 * r, work->gb + 6 * r};
            double* out = row + (size_t)r * (size_t)n6;
            double size2 = 0;
            for (int s = 0; s < 2; ++s) {
                if (ends[s] < 0)
                    continue;
                // the factor's diagonal holds 1/D: x = D^-1/2 L^-1 g
                const double* l = system->kkt.mass_factor + 36 * ends[s];
                double* x = out + 6 * ends[s];
                for (int i = 0; i < 6; ++i) {
                    x[i] = g[s][i];
                    for (int k = 0; k < i; ++k)
                        x[i] -= l[6 * i + k] * x[k];
                }
                for (int i = 0; i < 6; ++i) {
                    x[i] *= sqrt(l[7 * i]);
                    size2 += x[i] * x[i];
                }
            }
            const double s = size2 > 0 ? 1 / sqrt(size2) : 0;
            for (int k = 0; k < n6; ++k)
                out[k] *= s;
        }
    }
}

static double dot_n(const double* a, const double* b, int count) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Gram-Schmidt with row pivoting; returns the rank. used[r]: row r is one of the independent ones.
static int independent_rows(row_work* w, int rows, int columns) {
    for (int r = 0; r < rows; ++r)
        w->left[r] = 1;
    for (int rank = 0; rank < rows; ++rank) {
        int pick = -1;
        for (int r = 0; r < rows; ++r)
            if (!w->used[r] && (pick < 0 || w->left[r] > w->left[pick] * (1 + 1e-6)))
                pick = r;
        double* p = w->row + (size_t)pick * (size_t)columns;
        const double size = sqrt(dot_n(p, p, columns));
        if (!(size > DEPENDENT_SHARE))
            return rank;
        w->used[pick] = true;
        for (int k = 0; k < columns; ++k)
            p[k] /= size;
        for (int r = 0; r < rows; ++r) {
            double* x = w->row + (size_t)r * (size_t)columns;
            if (w->used[r])
                continue;
            const double share = dot_n(x, p, columns);
            for (int k = 0; k < columns; ++k)
                x[k] -= share * p[k];
            w->left[r] = sqrt(dot_n(x, x, columns));
        }
    }
    return rows;
}

/// Counts dependent rows at the assembled position and says where they are.
static bt_status find_dependent_rows(bt_system* system, const bt_state* state, bt_diag* diag) {
    const int m = system->constraint_count, n6 = 6 * system->body_count;
    system->redundant_count = 0;
    if (!system->kkt.loop_joint_count)
        return BT_OK; // rows of a tree are independent
    row_work w = {calloc((size_t)m * (size_t)n6, sizeof(double)), calloc((size_t)m, sizeof(double)),
                  calloc((size_t)m, sizeof(bool))};
    bt_status status = BT_ERR_MEMORY;
    if (w.row && w.left && w.used) {
        scaled_rows(system, bt_work_of(state), w.row);
        system->redundant_count = m - independent_rows(&w, m, n6);
        for (int j = 0; system->redundant_count && j < system->joint_count; ++j) {
            const bt_joint* joint = &system->joints[j];
            int count = 0;
            for (int r = joint->row; r < joint->row + joint->row_count; ++r)
                count += !w.used[r];
            if (count)
                bt_diag_add(diag, BT_NOTE, BT_NOWHERE,
                            "joint '%s': %d of its %d constraints follow from the others; joint "
                            "loads along them are the smallest that carry the motion",
                            joint->name, count, joint->row_count);
        }
        status = BT_OK;
    }
    free(w.row);
    free(w.left);
    free(w.used);
    return status;
}

/* ------------------------------------------------------------------ assembly */

static bt_status check_all(bt_system* system, bt_diag* diag) {
    bt_diag own = {0};
    bt_diag* d = diag ? diag : &own;
    const int before = d->errors;
    if (!system->body_count)
        bt_diag_add(d, BT_ERROR, BT_NOWHERE, "the system has no body");
    if (!finite_all(system->gravity_mps2, 3))
        bt_diag_add(d, BT_ERROR, BT_NOWHERE, "gravity must be finite");
    for (int b = 0; b < system->body_count; ++b)
        check_body(&system->bodies[b], d);
    system->smallest_scale = INFINITY;
    if (d->errors == before) // joints look at the attitudes of their bodies
        for (int j = 0; j < system->joint_count; ++j)
            check_joint(system, &system->joints[j], d);
    for (int i = 0; i < system->element_count; ++i)
        check_element(system, &system->elements[i].element, d);
    return d->errors == before ? BT_OK : BT_ERR_INPUT;
}

static bt_status make_kkt(bt_system* system) {
    bt_kkt_joint* joints = calloc((size_t)system->joint_count + 1, sizeof *joints);
    if (!joints)
        return BT_ERR_MEMORY;
    int row = 0;
    for (int j = 0; j < system->joint_count; ++j) {
        bt_joint* joint = &system->joints[j];
        joint->row = row;
        joint->row_count = bt_joint_row_count(joint->kind);
        joints[j] = (bt_kkt_joint){joint->body_a, joint->body_b, row, joint->row_count};
        row += joint->row_count;
    }
    system->constraint_count = row;
    bt_kkt_destroy(&system->kkt);
    const bt_status status =
        bt_kkt_create(&system->kkt, system->body_count, joints, system->joint_count);
    free(joints);
    if (status != BT_OK)
        return status;
    for (int b = 0; b < system->body_count; ++b)
        bt_kkt_set_mass(&system->kkt, b, system->bodies[b].mass_kg, system->bodies[b].inertia);
    system->refinements = system->kkt.loop_joint_count ? LOOP_REFINEMENTS : 0;
    return BT_OK;
}

/// g M^-1 g^T of one row on one body.
static double row_compliance(const bt_body* body, const double g[6]) {
    double turn[3];
    bt_rotate(body->inverse_inertia, g + 3, turn);
    return body->inverse_mass * bt_dot(g, g) + bt_dot(g + 3, turn);
}

static void set_epsilon(bt_system* system, const bt_state* state) {
    const bt_work* work = bt_work_of(state);
    for (int j = 0; j < system->joint_count; ++j) {
        const bt_joint* joint = &system->joints[j];
        bt_joint_jacobian(joint, state->q, state->rotation, work->ga + 6 * joint->row,
                          work->gb + 6 * joint->row);
        if (!system->kkt.closes_loop[j])
            continue;
        double largest = 0;
        for (int r = joint->row; r < joint->row + joint->row_count; ++r) {
            double own = 0;
            if (joint->body_a >= 0)
                own += row_compliance(&system->bodies[joint->body_a], work->ga + 6 * r);
            if (joint->body_b >= 0)
                own += row_compliance(&system->bodies[joint->body_b], work->gb + 6 * r);
            system->kkt.epsilon[r] = LOOP_EPSILON * own;
            largest = fmax(largest, own);
        }
        for (int r = joint->row; r < joint->row + joint->row_count; ++r)
            system->kkt.epsilon[r] = fmax(system->kkt.epsilon[r], 1e-4 * LOOP_EPSILON * largest);
    }
}

static void report_open_joint(const bt_system* system, int j, double residual, bt_diag* diag) {
    if (j < 0) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "the system cannot be assembled");
        return;
    }
    const bt_joint* joint = &system->joints[j];
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "joint '%s' (%s between '%s' and '%s'): cannot be assembled, a relative error of "
                "%.3g remains. Either the constraints contradict each other (axes or points that "
                "do not meet, lengths that do not reach) or the given positions are too far from "
                "a solution",
                joint->name, bt_joint_kind_name(joint->kind),
                joint->body_a < 0 ? "ground" : system->bodies[joint->body_a].name,
                joint->body_b < 0 ? "ground" : system->bodies[joint->body_b].name, residual);
}

/// A change of velocities at assembly above this share of the largest is worth a note.
#define NOTED_CHANGE 0.01

/// Says whose velocity had to change most to agree with the joints, in the unit of its own.
static void note_changed_velocity(const bt_system* system, const bt_state* state, bt_diag* diag) {
    double fastest = 0, most = 0;
    int changed = -1;
    for (int b = 0; b < system->body_count; ++b) {
        const bt_body* body = &system->bodies[b];
        const double size = gyration_radius(body), *now = state->v + 6 * b;
        double change2 = 0, speed2 = 0;
        for (int i = 0; i < 6; ++i) {
            const double per = i < 3 ? 1 : size, by = per * (now[i] - body->v[i]);
            change2 += by * by;
            speed2 += per * per * body->v[i] * body->v[i];
        }
        fastest = fmax(fastest, speed2);
        if (change2 > most) {
            most = change2;
            changed = b;
        }
    }
    if (changed < 0 || sqrt(most) <= NOTED_CHANGE * sqrt(fastest))
        return;
    const double *v = system->bodies[changed].v, *now = state->v + 6 * changed;
    bt_diag_add(diag, BT_NOTE, BT_NOWHERE,
                "body '%s': the given velocities break the joints and were changed, here from %.4g "
                "to %.4g m/s and from %.4g to %.4g rad/s; give every body the velocity that the "
                "joints ask for",
                system->bodies[changed].name, bt_norm(v), bt_norm(now), bt_norm(v + 3),
                bt_norm(now + 3));
}

/// Finds consistent positions and velocities near the given ones and keeps them in the bodies.
static bt_status find_start(bt_system* system, bt_state* state, bt_diag* diag) {
    bt_failure failure = {0};
    int worst;
    set_epsilon(system, state);
    const double residual = bt_close_positions(system, state, 200, 0.5, &worst, &failure);
    if (!(residual <= BT_CLOSED_ENOUGH)) {
        report_open_joint(system, worst, residual, diag);
        return BT_ERR_INPUT;
    }
    set_epsilon(system, state);
    if (!bt_factorise(system, state, &failure)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "joint '%s': its constraints are singular",
                    failure.where);
        return BT_ERR_INPUT;
    }
    bt_close_velocities(system, state);
    note_changed_velocity(system, state, diag);
    for (int b = 0; b < system->body_count; ++b) {
        memcpy(system->bodies[b].q, state->q + 7 * b, 7 * sizeof(double));
        memcpy(system->bodies[b].v, state->v + 6 * b, 6 * sizeof(double));
    }
    return find_dependent_rows(system, state, diag);
}

bt_status bt_system_assemble(bt_system* system, bt_diag* diag) {
    system->assembled = false;
    if (system->add_status != BT_OK)
        return system->add_status;
    BT_TRY(check_all(system, diag));
    BT_TRY(make_kkt(system));
    bt_arena arena = {0};
    BT_TRY(bt_arena_create(&arena, bt_state_size(system)));
    bt_state state;
    system->assembled = true; // what follows is a state like any other
    bt_status status = bt_state_create(system, &arena, &state);
    if (status == BT_OK)
        status = find_start(system, &state, diag);
    bt_arena_destroy(&arena);
    system->assembled = status == BT_OK;
    return status;
}

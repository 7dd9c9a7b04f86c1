#include "mechanics/joint.h"

#include "mechanics/vec.h"

/* row groups of a kind, in the order of its rows */
enum {
    POINT = 1,
    SLIDE = 2,
    NORMAL = 4,
    PARALLEL = 8,
    CROSS = 16,
    LOCK = 32,
    DISTANCE = 64,
};

static const struct {
    const char* name;
    unsigned groups;
    int rows;
    bool axis;
} kinds[] = {
    [BT_JOINT_REVOLUTE] = {"revolute", POINT | PARALLEL, 5, true},
    [BT_JOINT_PRISMATIC] = {"prismatic", SLIDE | LOCK, 5, true},
    [BT_JOINT_CYLINDRICAL] = {"cylindrical", SLIDE | PARALLEL, 4, true},
    [BT_JOINT_UNIVERSAL] = {"universal", POINT | CROSS, 4, true},
    [BT_JOINT_SPHERICAL] = {"spherical", POINT, 3, false},
    [BT_JOINT_FIXED] = {"fixed", POINT | LOCK, 6, false},
    [BT_JOINT_POINT_ON_LINE] = {"point-on-line", SLIDE, 2, true},
    [BT_JOINT_POINT_ON_PLANE] = {"point-on-plane", NORMAL, 1, true},
    [BT_JOINT_DISTANCE] = {"distance", DISTANCE, 1, false},
};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

static bool exists(bt_joint_kind kind) {
    return (int)kind >= 0 && (int)kind < KIND_COUNT;
}

int bt_joint_row_count(bt_joint_kind kind) {
    return exists(kind) ? kinds[kind].rows : 0;
}

int bt_joint_length_rows(bt_joint_kind kind) {
    const unsigned groups = kinds[kind].groups;
    return groups & POINT ? 3 : groups & SLIDE ? 2 : 1;
}

const char* bt_joint_kind_name(bt_joint_kind kind) {
    return exists(kind) ? kinds[kind].name : "unknown";
}

bool bt_joint_has_axis(bt_joint_kind kind) {
    return kinds[kind].axis;
}

bool bt_joint_aligns_axes(bt_joint_kind kind) {
    return (kinds[kind].groups & PARALLEL) != 0;
}

bool bt_joint_locks(bt_joint_kind kind) {
    return (kinds[kind].groups & LOCK) != 0;
}

void bt_joint_sides(const double axis[3], double side[2][3]) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (fabs(axis[i]) < fabs(axis[least]))
            least = i;
    double pick[3] = {0, 0, 0};
    pick[least] = 1;
    bt_cross(axis, pick, side[0]);
    const double s = 1 / bt_norm(side[0]);
    for (int i = 0; i < 3; ++i)
        side[0][i] *= s;
    bt_cross(axis, side[0], side[1]);
}

/// One end of a joint as the world sees it.
typedef struct end {
    const double *x, *e, *a;
    double arm[3]; ///< A s
} end;

static const double ground_q[7] = {0, 0, 0, 1, 0, 0, 0};
static const double ground_rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const double ground_v[6] = {0};

static inline end end_of(int body, const double s[3], const double* q, const double* rotation) {
    end it;
    it.x = body == BT_GROUND ? ground_q : q + 7 * body;
    it.e = it.x + 3;
    it.a = body == BT_GROUND ? ground_rotation : rotation + 9 * body;
    bt_rotate(it.a, s, it.arm);
    return it;
}

static inline void span(const end* a, const end* b, double d[3]) {
    for (int i = 0; i < 3; ++i)
        d[i] = b->x[i] + b->arm[i] - a->x[i] - a->arm[i];
}

static void lock_residual(const bt_joint* joint, const end* a, const end* b, double* phi) {
    double e_a[4], e_rel[4];
    bt_euler_multiply(a->e, joint->attitude_ab, e_a);
    bt_euler_relative(e_a, b->e, e_rel);
    const double s = e_rel[0] < 0 ? -2 : 2;
    const double vector[3] = {s * e_rel[1], s * e_rel[2], s * e_rel[3]};
    bt_rotate(b->a, vector, phi);
}

void bt_joint_residual(const bt_joint* joint, const double* q, const double* rotation,
                       double* phi) {
    const unsigned groups = kinds[joint->kind].groups;
    const end a = end_of(joint->body_a, joint->point_a, q, rotation);
    const end b = end_of(joint->body_b, joint->point_b, q, rotation);
    double d[3], d_a[3];
    span(&a, &b, d);
    bt_unrotate(a.a, d, d_a);
    if (groups & POINT)
        for (int i = 0; i < 3; ++i)
            *phi++ = d[i];
    if (groups & SLIDE) {
        *phi++ = bt_dot(joint->side_a[0], d_a);
        *phi++ = bt_dot(joint->side_a[1], d_a);
    }
    if (groups & NORMAL)
        *phi++ = bt_dot(joint->axis_a, d_a);
    if (groups & (PARALLEL | CROSS)) {
        double u[3], u_a[3];
        bt_rotate(b.a, joint->axis_b, u);
        bt_unrotate(a.a, u, u_a);
        if (groups & CROSS) {
            *phi++ = bt_dot(joint->axis_a, u_a);
        } else {
            *phi++ = bt_dot(joint->side_a[0], u_a);
            *phi++ = bt_dot(joint->side_a[1], u_a);
        }
    }
    if (groups & LOCK)
        lock_residual(joint, &a, &b, phi);
    if (groups & DISTANCE)
        *phi = (bt_dot(d, d) - joint->length_m * joint->length_m) / (2 * joint->length_m);
}

/// Rows d = 0: [I, -A s~] for b, the opposite for a.
static inline void point_rows(const double a[9], const double s[3], double sign, double* g) {
    for (int i = 0; i < 3; ++i) {
        double* row = g + 6 * i;
        const double* r = a + 3 * i; // row i of A; -A s~ has rows s x r
        row[0] = row[1] = row[2] = 0;
        row[i] = sign;
        row[3] = sign * (s[1] * r[2] - s[2] * r[1]);
        row[4] = sign * (s[2] * r[0] - s[0] * r[2]);
        row[5] = sign * (s[0] * r[1] - s[1] * r[0]);
    }
}

/// A row f . (velocity of the point at `arm` from the centre): [f, A^T (arm x f)].
static inline void force_row(const double a[9], const double arm[3], const double f[3], double sign,
                             double* row) {
    double moment[3], local[3];
    bt_cross(arm, f, moment);
    bt_unrotate(a, moment, local);
    for (int i = 0; i < 3; ++i) {
        row[i] = sign * f[i];
        row[3 + i] = sign * local[i];
    }
}

/// A row c . omega: [0, A^T c].
static inline void turn_row(const double a[9], const double c[3], double sign, double* row) {
    double local[3];
    bt_unrotate(a, c, local);
    for (int i = 0; i < 3; ++i) {
        row[i] = 0;
        row[3 + i] = sign * local[i];
    }
}

void bt_joint_jacobian(const bt_joint* joint, const double* q, const double* rotation, double* ga,
                       double* gb) {
    const unsigned groups = kinds[joint->kind].groups;
    const end a = end_of(joint->body_a, joint->point_a, q, rotation);
    const end b = end_of(joint->body_b, joint->point_b, q, rotation);
    int row = 0;
    if (groups & POINT) {
        point_rows(a.a, joint->point_a, -1, ga);
        point_rows(b.a, joint->point_b, 1, gb);
        row = 3;
    }
    if (groups & (SLIDE | NORMAL | DISTANCE)) {
        double d[3], arm[3], f[3]; // arm: from the centre of a to the point of b
        span(&a, &b, d);
        for (int i = 0; i < 3; ++i)
            arm[i] = a.arm[i] + d[i];
        const int count = groups & SLIDE ? 2 : 1;
        for (int k = 0; k < count; ++k, ++row) {
            if (groups & DISTANCE)
                for (int i = 0; i < 3; ++i)
                    f[i] = d[i] / joint->length_m;
            else
                bt_rotate(a.a, groups & SLIDE ? joint->side_a[k] : joint->axis_a, f);
            force_row(a.a, arm, f, -1, ga + 6 * row);
            force_row(b.a, b.arm, f, 1, gb + 6 * row);
        }
    }
    if (groups & (PARALLEL | CROSS)) {
        double u[3], p[3], c[3];
        bt_rotate(b.a, joint->axis_b, u);
        const int count = groups & PARALLEL ? 2 : 1;
        for (int k = 0; k < count; ++k, ++row) {
            bt_rotate(a.a, groups & PARALLEL ? joint->side_a[k] : joint->axis_a, p);
            bt_cross(p, u, c);
            turn_row(a.a, c, 1, ga + 6 * row);
            turn_row(b.a, c, -1, gb + 6 * row);
        }
    }
    if (groups & LOCK)
        for (int i = 0; i < 3; ++i, ++row)
            for (int k = 0; k < 3; ++k) {
                ga[6 * row + k] = gb[6 * row + k] = 0;
                ga[6 * row + 3 + k] = -a.a[3 * i + k];
                gb[6 * row + 3 + k] = b.a[3 * i + k];
            }
}

/// Rates of one end: velocity of its point, world angular velocity, and the part of the point's
/// acceleration that the velocities alone make, omega x (omega x arm).
typedef struct rate {
    double velocity[3], omega[3], centripetal[3];
} rate;

static inline rate rate_of(int body, const end* it, const double* v) {
    rate r;
    const double* vb = body == BT_GROUND ? ground_v : v + 6 * body;
    double turn[3];
    bt_rotate(it->a, vb + 3, r.omega);
    bt_cross(r.omega, it->arm, turn);
    bt_cross(r.omega, turn, r.centripetal);
    for (int i = 0; i < 3; ++i)
        r.velocity[i] = vb[i] + turn[i];
    return r;
}

void bt_joint_gamma(const bt_joint* joint, const double* q, const double* rotation, const double* v,
                    double* gamma) {
    const unsigned groups = kinds[joint->kind].groups;
    const end a = end_of(joint->body_a, joint->point_a, q, rotation);
    const end b = end_of(joint->body_b, joint->point_b, q, rotation);
    const rate ra = rate_of(joint->body_a, &a, v), rb = rate_of(joint->body_b, &b, v);
    double pull[3]; // velocity part of the second derivative of d
    for (int i = 0; i < 3; ++i)
        pull[i] = rb.centripetal[i] - ra.centripetal[i];
    if (groups & POINT)
        for (int i = 0; i < 3; ++i)
            *gamma++ = -pull[i];
    if (groups & (SLIDE | NORMAL | DISTANCE)) {
        double d[3], d1[3];
        span(&a, &b, d);
        for (int i = 0; i < 3; ++i)
            d1[i] = rb.velocity[i] - ra.velocity[i];
        if (groups & DISTANCE)
            *gamma++ = -(bt_dot(d1, d1) + bt_dot(d, pull)) / joint->length_m;
        const int count = groups & SLIDE ? 2 : groups & NORMAL ? 1 : 0;
        for (int k = 0; k < count; ++k) {
            double p[3], p1[3], p2[3];
            bt_rotate(a.a, groups & SLIDE ? joint->side_a[k] : joint->axis_a, p);
            bt_cross(ra.omega, p, p1);
            bt_cross(ra.omega, p1, p2);
            *gamma++ = -(bt_dot(p2, d) + 2 * bt_dot(p1, d1) + bt_dot(p, pull));
        }
    }
    if (groups & (PARALLEL | CROSS)) {
        double u[3], u1[3], u2[3];
        bt_rotate(b.a, joint->axis_b, u);
        bt_cross(rb.omega, u, u1);
        bt_cross(rb.omega, u1, u2);
        const int count = groups & PARALLEL ? 2 : 1;
        for (int k = 0; k < count; ++k) {
            double p[3], p1[3], p2[3];
            bt_rotate(a.a, groups & PARALLEL ? joint->side_a[k] : joint->axis_a, p);
            bt_cross(ra.omega, p, p1);
            bt_cross(ra.omega, p1, p2);
            *gamma++ = -(bt_dot(p2, u) + 2 * bt_dot(p1, u1) + bt_dot(p, u2));
        }
    }
    if (groups & LOCK) // rows are A_b omega_b - A_a omega_a, whose rates hold no velocity terms
        gamma[0] = gamma[1] = gamma[2] = 0;
}

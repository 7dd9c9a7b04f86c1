#include "elements/carcass.h"
#include "elements/tyre.h"

#include <math.h>

double bt_tyre_segment_area(double radius_m, double deflection_m) {
    if (!(deflection_m > 0))
        return 0;
    // Half the angle that the chord subtends; exact also for small deflections.
    const double half = 2 * asin(sqrt(fmin(deflection_m / (2 * radius_m), 1)));
    return radius_m * radius_m * (half - 0.5 * sin(2 * half));
}

double bt_tyre_equivalent_deflection(double radius_m, double area_m2) {
    const double pi = acos(-1.0), a = area_m2 / (radius_m * radius_m);
    if (!(a > 0))
        return 0;
    if (a >= pi)
        return 2 * radius_m;
    // a = t - sin t cos t; the start is the root of its series, from where Newton converges.
    double t = fmin(cbrt(1.5 * a), pi - 1e-3);
    for (int i = 0; i < 30; ++i) {
        const double s = sin(t);
        const double step = (t - s * cos(t) - a) / (2 * s * s);
        t = fmin(fmax(t - step, 0.5 * t), 0.5 * (t + pi));
        if (fabs(step) <= 4e-16 * t)
            break;
    }
    const double s = sin(0.5 * t);
    return 2 * radius_m * s * s;
}

/// The ground as seen from the axle: what the rays run into.
typedef struct ground {
    double radius, height; ///< radius of the disc; height of the axle above the deck
    const bt_bump* bumps;
    int count;
} ground;

/// Sums over the strips of one share: area, first moments, area-weighted direction.
typedef struct sums {
    double area, moment_u, moment_w, area_g_u, area_g_w;
} sums;

/// Where the ray of direction (s, -c) meets something.
typedef struct hit {
    double distance;
    double g_u, g_w; ///< inward direction there
} hit;

static void nearer(hit* best, double distance, double g_u, double g_w) {
    if (distance < best->distance)
        *best = (hit){distance, g_u, g_w};
}

static void hit_circle(const bt_bump* b, double s, double c, hit* best) {
    const double along = b->u_m * s - b->w_m * c;
    const double across = b->u_m * c + b->w_m * s;
    const double square = b->size_m * b->size_m - across * across;
    if (square < 0 || along <= 0)
        return;
    const double rho = fmax(along - sqrt(square), 0);
    nearer(best, rho, (rho * s - b->u_m) / b->size_m, (-rho * c - b->w_m) / b->size_m);
}

/// A block on the deck: its top, and the upright face that looks at the axle.
static void hit_step(const bt_bump* b, double height, double s, double c, hit* best) {
    const double top = height - b->size_m;
    const double u = top * s / c;
    if (u >= b->u_m && u <= b->w_m)
        nearer(best, top / c, 0, 1);
    const double face = b->u_m > 0 ? b->u_m : b->w_m < 0 ? b->w_m : 0;
    if (face * s <= 0)
        return;
    const double rho = face / s;
    if (rho * c >= top && rho * c <= height)
        nearer(best, rho, face > 0 ? -1 : 1, 0);
}

/// The nearest thing along a ray; *what is -1 for the deck or the bump's index.
static hit cast(const ground* g, double s, double c, int* what) {
    hit best = {c > 0 ? g->height / c : INFINITY, 0, 1};
    *what = -1;
    for (int i = 0; i < g->count; ++i) {
        const double before = best.distance;
        if (g->bumps[i].kind == BT_BUMP_CIRCLE)
            hit_circle(&g->bumps[i], s, c, &best);
        else
            hit_step(&g->bumps[i], g->height, s, c, &best);
        if (best.distance < before)
            *what = i;
    }
    return best;
}

/// All strips between two angles that a level floor bounds, in closed form.
static void add_floor(sums* sum, double radius, double height, double t0, double t1) {
    const double r3 = radius * radius * radius, h3 = height * height * height;
    const double c0 = cos(t0), c1 = cos(t1), s0 = sin(t0), s1 = sin(t1);
    const double tangents = s1 / c1 - s0 / c0;
    const double area = 0.5 * (radius * radius * (t1 - t0) - height * height * tangents);
    sum->area += area;
    sum->area_g_w += area;
    sum->moment_u += (r3 * (c0 - c1) - 0.5 * h3 * (1 / (c1 * c1) - 1 / (c0 * c0))) / 3;
    sum->moment_w -= (r3 * (s1 - s0) - h3 * tangents) / 3;
}

/// Narrow strips between two angles, each given to what bounds it at its middle.
static void add_strips(const ground* g, sums* share, int strips, double t0, double t1) {
    const double width = (t1 - t0) / strips, r = g->radius;
    const double turn_s = sin(width), turn_c = cos(width);
    double s = sin(t0 + 0.5 * width), c = cos(t0 + 0.5 * width);
    for (int i = 0; i < strips; ++i) {
        int what;
        const hit h = cast(g, s, c, &what);
        if (h.distance < r) {
            sums* sum = &share[what + 1];
            const double rho = h.distance;
            const double area = 0.5 * (r * r - rho * rho) * width;
            const double moment = (r * r * r - rho * rho * rho) * width / 3;
            sum->area += area;
            sum->moment_u += moment * s;
            sum->moment_w -= moment * c;
            sum->area_g_u += area * h.g_u;
            sum->area_g_w += area * h.g_w;
        }
        const double turned = s * turn_c + c * turn_s;
        c = c * turn_c - s * turn_s;
        s = turned;
    }
}

enum { ANGLE_MAX = 3 + 10 * BT_BUMP_MAX };

typedef struct angles {
    int count;
    double value[ANGLE_MAX];
} angles;

static void add_angle(angles* list, double u, double depth) {
    if (depth > 0)
        list->value[list->count++] = atan2(u, depth);
}

/// The points of the disc's rim where a level floor cuts it.
static void add_floor_angles(angles* list, double radius, double height) {
    if (!(height < radius) || height <= 0)
        return;
    const double half = acos(height / radius);
    list->value[list->count++] = -half;
    list->value[list->count++] = half;
}

/// Where a circle comes into sight, leaves the disc, and sinks into the deck.
static void add_circle_angles(angles* list, const ground* g, const bt_bump* b) {
    const double r = b->size_m, big = g->radius, pi_2 = acos(0.0);
    const double d = sqrt(b->u_m * b->u_m + b->w_m * b->w_m);
    if (d >= big + r || d <= r)
        return;
    const double middle = atan2(b->u_m, -b->w_m);
    const double half =
        d * d - r * r > big * big ? acos((d * d + big * big - r * r) / (2 * d * big)) : asin(r / d);
    list->value[list->count++] = fmin(fmax(middle - half, -pi_2), pi_2);
    list->value[list->count++] = fmin(fmax(middle + half, -pi_2), pi_2);
    const double above = b->w_m + g->height;
    if (fabs(above) < r) {
        const double chord = sqrt(r * r - above * above);
        add_angle(list, b->u_m - chord, g->height);
        add_angle(list, b->u_m + chord, g->height);
    }
}

static void add_step_angles(angles* list, const ground* g, const bt_bump* b) {
    const double top = g->height - b->size_m, big = g->radius;
    add_floor_angles(list, big, top);
    for (int i = 0; i < 2; ++i) {
        const double u = i == 0 ? b->u_m : b->w_m;
        add_angle(list, u, top);
        add_angle(list, u, g->height);
        if (fabs(u) < big)
            list->value[list->count++] = asin(u / big);
    }
}

static void sort(angles* list) {
    for (int i = 1; i < list->count; ++i) {
        const double value = list->value[i];
        int j = i;
        for (; j > 0 && list->value[j - 1] > value; --j)
            list->value[j] = list->value[j - 1];
        list->value[j] = value;
    }
}

/// Cuts the disc at every angle where what bounds it changes, and adds piece by piece.
static void add_pieces(const bt_tyre* tyre, const ground* g, sums* share) {
    angles list = {0};
    add_floor_angles(&list, g->radius, g->height);
    for (int i = 0; i < g->count; ++i)
        if (g->bumps[i].kind == BT_BUMP_CIRCLE)
            add_circle_angles(&list, g, &g->bumps[i]);
        else
            add_step_angles(&list, g, &g->bumps[i]);
    sort(&list);
    for (int i = 0; i + 1 < list.count; ++i) {
        const double t0 = list.value[i], t1 = list.value[i + 1];
        if (!(t1 > t0))
            continue;
        int what;
        const double middle = 0.5 * (t0 + t1);
        const hit h = cast(g, sin(middle), cos(middle), &what);
        if (!(h.distance < g->radius))
            continue;
        if (what < 0)
            add_floor(&share[0], g->radius, g->height, t0, t1);
        else
            add_strips(g, share, tyre->strips, t0, t1);
    }
}

/// Adds to a share what the carcass presses in beside it; takes away down to nothing.
static void add_bridge(sums* share, double area, double u, double w, double g_u, double g_w) {
    if (area <= -share->area) {
        *share = (sums){0};
        return;
    }
    if (area < 0) {
        const double left = 1 + area / share->area;
        *share = (sums){share->area * left, share->moment_u * left, share->moment_w * left,
                        share->area_g_u * left, share->area_g_w * left};
        return;
    }
    share->area += area;
    share->moment_u += area * u;
    share->moment_w += area * w;
    share->area_g_u += area * g_u;
    share->area_g_w += area * g_w;
}

/// The carcass over one rope: what it adds to the rope's share it takes in part from the deck's;
/// all of it where the rope alone presses in more: it then holds the tread off the deck. Where the
/// tread comes down, the deck carries what it adds and takes as much from the rope, up to its
/// share.
static void bridge_circle(const bt_tyre* tyre, const ground* g, const bt_bump* b, sums* deck,
                          sums* share) {
    const double away = hypot(b->u_m, b->w_m), r = b->size_m, big = g->radius;
    const double depth = big + r - away, deflection = big - g->height;
    const double arc = big * atan2(b->u_m, -b->w_m), rho = big * r / (big + r);
    const double level = bt_carcass_on_floor(tyre->bridging, big, deflection, arc);
    const double bare_level = bt_carcass_on_floor(0, big, deflection, arc);
    const bt_bridge taut = bt_carcass_over_cylinder(tyre->bridging, rho, depth, level);
    const bt_bridge bare = bt_carcass_over_cylinder(0, rho, depth, bare_level);
    const double added = taut.above_m2 - bare.above_m2;
    double from_deck = fmin(taut.carried_m2 - bare.carried_m2 - added, deck->area);
    double more = added + from_deck;
    if (level > 0) {
        const double alone = bt_carcass_over_cylinder(tyre->bridging, rho, depth, 0).above_m2 -
                             bt_carcass_over_cylinder(0, rho, depth, 0).above_m2;
        const double beyond = fmax(deck->area + added - alone, 0);
        const double on_deck = fmin(deck->area - from_deck, 2 * beyond);
        more = fmax(added, alone - deck->area) + deck->area - on_deck;
        from_deck = deck->area - on_deck;
    }
    const double n_u = -b->u_m / away, n_w = -b->w_m / away;
    add_bridge(deck, -from_deck, 0, -g->height, 0, 1);
    add_bridge(share, more, b->u_m + r * n_u, b->w_m + r * n_w, n_u, n_w);
}

static void add_bridges(const bt_tyre* tyre, const ground* g, sums* share) {
    const double beside = bt_carcass_beside_patch(tyre->bridging, g->radius, g->radius - g->height);
    add_bridge(&share[0], beside, 0, -g->height, 0, 1);
    for (int i = 0; i < g->count; ++i)
        if (g->bumps[i].kind == BT_BUMP_CIRCLE && share[i + 1].area > 0)
            bridge_circle(tyre, g, &g->bumps[i], &share[0], &share[i + 1]);
}

/// Eqs. 6 and 7 of one share.
static bt_patch patch_of(const sums* sum) {
    if (!(sum->area > 0))
        return (bt_patch){0};
    return (bt_patch){sum->area, sum->moment_u / sum->area, sum->moment_w / sum->area,
                      sum->area_g_u / sum->area, sum->area_g_w / sum->area};
}

void bt_tyre_envelope(const bt_tyre* tyre, double wheel_height_m, const bt_bump* bumps, int n,
                      bt_envelope* out) {
    const double radius = tyre->radius;
    const ground g = {radius, fmax(wheel_height_m, 0.05 * radius), bumps, n};
    sums share[BT_BUMP_MAX + 1] = {{0}}, all = {0};
    add_pieces(tyre, &g, share);
    if (tyre->bridging > 0 && n > 0)
        add_bridges(tyre, &g, share);
    for (int i = 0; i <= n; ++i) {
        all.area += share[i].area;
        all.moment_u += share[i].moment_u;
        all.moment_w += share[i].moment_w;
        all.area_g_u += share[i].area_g_u;
        all.area_g_w += share[i].area_g_w;
    }
    *out = (bt_envelope){.all = patch_of(&all), .ground = patch_of(&share[0])};
    for (int i = 0; i < n; ++i)
        out->bump[i] = patch_of(&share[i + 1]);
    // A flat deck needs no inversion.
    out->deflection_m = all.area > share[0].area
                            ? bt_carcass_equivalent_deflection(tyre->bridging, radius, all.area)
                            : fmax(radius - g.height, 0);
}

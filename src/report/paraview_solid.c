#include "report/paraview_solid.h"

#include "report/playback_geometry.h"

#include <math.h>

static const double two_pi = 6.283185307179586;

static int add_point(bt_solid* s, int body, double x, double y, double z) {
    if (s->point_count == BT_SOLID_POINTS_MAX)
        return s->point_count - 1;
    s->local[s->point_count][0] = x;
    s->local[s->point_count][1] = y;
    s->local[s->point_count][2] = z;
    s->body[s->point_count] = body;
    return s->point_count++;
}

static void add_cell(bt_cells* cells, int part, const int* corner, int count) {
    if (cells->count == BT_SOLID_CELLS_MAX || cells->corner_count + count > BT_SOLID_CORNERS_MAX)
        return;
    for (int i = 0; i < count; ++i)
        cells->corner[cells->corner_count++] = corner[i];
    cells->part[cells->count] = part;
    cells->end[cells->count++] = cells->corner_count;
}

static void add_line(bt_solid* s, int body, const double from[3], const double to[3]) {
    const int ends[2] = {add_point(s, body, from[0], from[1], from[2]),
                         add_point(s, body, to[0], to[1], to[2])};
    add_cell(&s->lines, body, ends, 2);
}

/// A prism between two rings of points that were added one after the other.
static void add_prism(bt_solid* s, int body, int first, int count) {
    int ring[BT_OUTLINE_MAX];
    for (int side = 0; side < 2; ++side) {
        for (int i = 0; i < count; ++i)
            ring[i] = first + side * count + (side ? i : count - 1 - i);
        add_cell(&s->polygons, body, ring, count);
    }
    for (int i = 0; i < count; ++i) {
        const int next = (i + 1) % count;
        const int face[4] = {first + i, first + next, first + count + next, first + count + i};
        add_cell(&s->polygons, body, face, 4);
    }
}

/// A drum about an axis parallel to y (0 1 0) or x (1 0 0), from `low` to `high` along it.
static void add_drum(bt_solid* s, int body, bool along_x, const double centre[3], double radius,
                     double low, double high) {
    enum { SIDES = 24 };
    const int first = s->point_count;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < SIDES; ++i) {
            const double a = two_pi * i / SIDES, along = side ? high : low;
            const double c = radius * cos(a), z = centre[2] + radius * sin(a);
            if (along_x)
                add_point(s, body, centre[0] + along, centre[1] + c, z);
            else
                add_point(s, body, centre[0] + c, centre[1] + along, z);
        }
    add_prism(s, body, first, SIDES);
}

static void add_fuselage(bt_solid* s, const bt_airframe* f) {
    const bt_fuselage_sketch sketch = bt_fuselage_of(f);
    const double centre[3] = {0, 0, sketch.height_m};
    add_drum(s, BT_BODY_FUSELAGE, true, centre, sketch.radius_m, sketch.tail_m, sketch.nose_m);
}

static void add_legs(bt_solid* s, const bt_airframe* f) {
    static const double axle[3] = {0, 0, 0};
    for (int leg = 0; leg < BT_LEG_COUNT; ++leg) {
        const double* at = f->axle_m[leg];
        const double x = at[0] - f->fuselage_m[0], y = at[1] - f->fuselage_m[1];
        const double top[3] = {x, y, 0}, foot[3] = {x, y, 0.45 * (at[2] - f->fuselage_m[2])};
        const double head[3] = {0, 0, -0.6 * at[2]};
        add_line(s, BT_BODY_FUSELAGE, top, foot);
        add_line(s, BT_BODY_NOSE_PISTON + leg, axle, head);
        const double half = 0.5 * f->tyre_width_m[leg];
        add_drum(s, BT_BODY_NOSE_WHEEL + leg, false, axle, f->tyre[leg].radius, -half, half);
    }
}

static void add_hook(bt_solid* s, const bt_airframe* f, double length_m) {
    double outline[BT_OUTLINE_MAX][2];
    const double reach = fmin(0.4, 0.5 * length_m);
    const int count = bt_hook_outline(&f->profile, reach, outline), first = s->point_count;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < count; ++i)
            add_point(s, BT_BODY_HOOK, f->shoe_m[0] + outline[i][0],
                      f->shoe_m[1] + side * f->profile.half_width, f->shoe_m[2] + outline[i][1]);
    add_prism(s, BT_BODY_HOOK, first, count);
    const double from[3] = {f->shoe_m[0] + reach, 0, 0}, to[3] = {f->shoe_m[0] + length_m, 0, 0};
    add_line(s, BT_BODY_HOOK, from, to);
}

void bt_solid_build(bt_solid* solid, const bt_airframe* airframe, double hook_length_m) {
    solid->point_count = 0;
    solid->lines.count = solid->lines.corner_count = 0;
    solid->polygons.count = solid->polygons.corner_count = 0;
    add_fuselage(solid, airframe);
    add_legs(solid, airframe);
    add_hook(solid, airframe, hook_length_m);
}

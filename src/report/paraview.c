#include "report/paraview.h"

#include "base/directory.h"
#include "mechanics/vec.h"
#include "report/paraview_solid.h"
#include "report/playback_record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char head[] = "<?xml version=\"1.0\"?>\n<!-- written by bolter -->\n";

/// A landing on its way into files.
typedef struct scene {
    const bt_playback* p;
    const bt_model_params* model;
    const bt_solid* solid;
    char folder[BT_FILE_PATH_MAX]; ///< folder of the .vtp files
    size_t row;                    ///< that is being written
    bt_diag* diag;
} scene;

typedef void writer(FILE* out, const scene* s);

/// Lets a function write a text, and puts it under a path.
static bt_status store(const scene* s, const char* path, writer* write) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    fputs(head, out);
    write(out, s);
    const bool good = fclose(out) == 0;
    const bt_status status =
        good ? bt_file_replace(path, text, size, sizeof head - 1, s->diag) : BT_ERR_MEMORY;
    free(text);
    return status;
}

// --- VTK XML ----------------------------------------------------------------------------------

static void begin_piece(FILE* out, int points, int lines, int polygons) {
    fprintf(out,
            "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n"
            "<Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" NumberOfLines=\"%d\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"%d\">\n",
            points, lines, polygons);
}

static void end_piece(FILE* out) {
    fputs("</Piece>\n</PolyData>\n</VTKFile>\n", out);
}

static void begin_array(FILE* out, const char* type, const char* name, int components) {
    fprintf(out, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n",
            type, name, components);
}

static void end_array(FILE* out) {
    fputs("\n</DataArray>\n", out);
}

static void put_cells(FILE* out, const char* name, const bt_cells* cells) {
    fprintf(out, "<%s>\n", name);
    begin_array(out, "Int32", "connectivity", 1);
    for (int i = 0; i < cells->corner_count; ++i)
        fprintf(out, "%d ", cells->corner[i]);
    end_array(out);
    begin_array(out, "Int32", "offsets", 1);
    for (int i = 0; i < cells->count; ++i)
        fprintf(out, "%d ", cells->end[i]);
    end_array(out);
    fprintf(out, "</%s>\n", name);
}

// --- deck -------------------------------------------------------------------------------------

static void write_deck(FILE* out, const scene* s) {
    const double half = 0.7 * s->model->deck.cable.span_m;
    begin_piece(out, 4, 0, 1);
    fputs("<Points>\n", out);
    begin_array(out, "Float32", "points", 3);
    fprintf(out, "-60 %g 0 -60 %g 0 60 %g 0 60 %g 0", half, -half, -half, half);
    end_array(out);
    fputs("</Points>\n", out);
    const bt_cells square = {.count = 1, .corner_count = 4, .end = {4}, .corner = {0, 1, 2, 3}};
    put_cells(out, "Polys", &square);
    end_piece(out);
}

// --- airframe ---------------------------------------------------------------------------------

static void put_airframe_points(FILE* out, const scene* s) {
    double place[BT_BODY_COUNT][3], turn[BT_BODY_COUNT][9];
    const float* q = s->p->q + s->row * BT_PLAYBACK_Q;
    for (int body = 0; body < BT_BODY_COUNT; ++body) {
        double e[4];
        for (int i = 0; i < 3; ++i)
            place[body][i] = (double)q[7 * body + i];
        for (int i = 0; i < 4; ++i)
            e[i] = (double)q[7 * body + 3 + i];
        bt_rotation_from_euler(e, turn[body]);
    }
    fputs("<Points>\n", out);
    begin_array(out, "Float32", "points", 3);
    for (int k = 0; k < s->solid->point_count; ++k) {
        const double *l = s->solid->local[k], *a = turn[s->solid->body[k]];
        const double* r = place[s->solid->body[k]];
        for (int i = 0; i < 3; ++i)
            fprintf(out, "%.6g ",
                    r[i] + a[3 * i] * l[0] + a[3 * i + 1] * l[1] + a[3 * i + 2] * l[2]);
    }
    end_array(out);
    fputs("</Points>\n", out);
}

static void put_forces(FILE* out, const scene* s, const bt_cells* cells) {
    const float* force = s->p->curve + s->row * BT_CURVE_COUNT + BT_CURVE_CABLE_HOOK;
    for (int i = 0; i < cells->count; ++i)
        if (cells->part[i] == BT_BODY_HOOK)
            fprintf(out, "%.5g %.5g %.5g ", (double)force[0], (double)force[1], (double)force[2]);
        else
            fputs("0 0 0 ", out);
}

static void write_airframe(FILE* out, const scene* s) {
    const bt_cells *lines = &s->solid->lines, *polygons = &s->solid->polygons;
    begin_piece(out, s->solid->point_count, lines->count, polygons->count);
    fputs("<CellData>\n", out);
    begin_array(out, "Int32", "part", 1);
    for (int i = 0; i < lines->count; ++i)
        fprintf(out, "%d ", lines->part[i]);
    for (int i = 0; i < polygons->count; ++i)
        fprintf(out, "%d ", polygons->part[i]);
    end_array(out);
    begin_array(out, "Float32", "cable_force_N", 3);
    put_forces(out, s, lines);
    put_forces(out, s, polygons);
    end_array(out);
    fputs("</CellData>\n", out);
    put_airframe_points(out, s);
    put_cells(out, "Lines", lines);
    put_cells(out, "Polys", polygons);
    end_piece(out);
}

// --- cable ------------------------------------------------------------------------------------

/// Curvature at a point between two others, 1/m: that of the circle through the three.
static double curvature(const float* a, const float* b, const float* c) {
    double u[3], v[3], w[3], n[3];
    for (int i = 0; i < 3; ++i) {
        u[i] = (double)b[i] - (double)a[i];
        v[i] = (double)c[i] - (double)b[i];
        w[i] = (double)c[i] - (double)a[i];
    }
    bt_cross(u, v, n);
    const double product = sqrt(bt_dot(u, u) * bt_dot(v, v) * bt_dot(w, w));
    return product > 0 ? 2 * sqrt(bt_dot(n, n)) / product : 0;
}

static void write_cable(FILE* out, const scene* s) {
    const int n = s->p->nodes;
    const float* x = s->p->cable + s->row * 3 * (size_t)n;
    const float* tension = s->p->tension + s->row * (size_t)n;
    begin_piece(out, n, 1, 0);
    fputs("<PointData>\n", out);
    begin_array(out, "Float32", "tension_N", 1);
    for (int i = 0; i < n; ++i)
        fprintf(out, "%.6g ", (double)tension[i]);
    end_array(out);
    begin_array(out, "Float32", "curvature_per_m", 1);
    for (int i = 0; i < n; ++i)
        fprintf(out, "%.4g ",
                i > 0 && i < n - 1 ? curvature(x + 3 * i - 3, x + 3 * i, x + 3 * i + 3) : 0);
    end_array(out);
    fputs("</PointData>\n<Points>\n", out);
    begin_array(out, "Float32", "points", 3);
    for (int i = 0; i < 3 * n; ++i)
        fprintf(out, "%.6g ", (double)x[i]);
    end_array(out);
    fputs("</Points>\n<Lines>\n", out);
    begin_array(out, "Int32", "connectivity", 1);
    for (int i = 0; i < n; ++i)
        fprintf(out, "%d ", i);
    end_array(out);
    begin_array(out, "Int32", "offsets", 1);
    fprintf(out, "%d", n);
    end_array(out);
    fputs("</Lines>\n", out);
    end_piece(out);
}

// --- collection -------------------------------------------------------------------------------

/// The rows of a collection, and the name of its folder.
typedef struct collection {
    scene scene; ///< first: a writer of the collection is given the scene
    const size_t* row;
    size_t rows;
    const char* name;
} collection;

static void write_collection(FILE* out, const scene* s) {
    const collection* c = (const collection*)(const void*)s;
    const double begin = s->p->time_s[c->row[0]];
    fputs("<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
          "<Collection>\n",
          out);
    for (size_t i = 0; i < c->rows; ++i) {
        const double time = s->p->time_s[c->row[i]] - begin;
        fprintf(out, "<DataSet timestep=\"%.7g\" part=\"0\" file=\"%s/deck.vtp\"/>\n", time,
                c->name);
        fprintf(out, "<DataSet timestep=\"%.7g\" part=\"1\" file=\"%s/airframe_%04zu.vtp\"/>\n",
                time, c->name, i);
        fprintf(out, "<DataSet timestep=\"%.7g\" part=\"2\" file=\"%s/cable_%04zu.vtp\"/>\n", time,
                c->name, i);
    }
    fputs("</Collection>\n</VTKFile>\n", out);
}

static bt_status store_part(const scene* s, const char* name, writer* write) {
    char path[BT_FILE_PATH_MAX];
    BT_TRY(bt_file_path(path, s->folder, name));
    return store(s, path, write);
}

static bt_status store_all(collection* c, const char* path) {
    scene* s = &c->scene;
    BT_TRY(bt_directory_make(s->folder, s->diag));
    BT_TRY(store_part(s, "deck.vtp", write_deck));
    for (size_t i = 0; i < c->rows; ++i) {
        char name[32];
        s->row = c->row[i];
        snprintf(name, sizeof name, "airframe_%04zu.vtp", i);
        BT_TRY(store_part(s, name, write_airframe));
        snprintf(name, sizeof name, "cable_%04zu.vtp", i);
        BT_TRY(store_part(s, name, write_cable));
    }
    return store(s, path, write_collection);
}

static bt_status build(scene* s, bt_solid* solid) {
    bt_airframe airframe;
    BT_TRY(bt_airframe_build(&s->model->aircraft, s->model->deck.gravity_mps2,
                             0.5 * s->model->deck.cable.diameter_m, &airframe, s->diag));
    bt_solid_build(solid, &airframe, s->model->aircraft.hook.length_m);
    bt_airframe_destroy(&airframe);
    s->solid = solid;
    return BT_OK;
}

bt_status bt_paraview_write(const char* path, const bt_playback* p, const bt_model_params* model,
                            bt_diag* diag) {
    if (p->out_of_memory)
        return BT_ERR_MEMORY;
    if (p->count == 0)
        return BT_OK;
    size_t* row = malloc(p->count * sizeof *row);
    bt_solid* solid = malloc(sizeof *solid);
    collection c = {.scene = {.p = p, .model = model, .diag = diag}, .row = row};
    bt_status status = row && solid ? build(&c.scene, solid) : BT_ERR_MEMORY;
    if (status == BT_OK) {
        const char* dot = strrchr(path, '.');
        snprintf(c.scene.folder, sizeof c.scene.folder, "%.*s",
                 (int)(dot ? dot - path : (long)strlen(path)), path);
        const char* slash = strrchr(c.scene.folder, '/');
        c.name = slash ? slash + 1 : c.scene.folder;
        c.rows = bt_playback_choose_rows(p, row);
        status = store_all(&c, path);
    }
    free(row);
    free(solid);
    return status;
}

#include "study/rig_inputs.h"

#include "landing/leg.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The part of the aircraft that each rig tests.
static const char* const parts[BT_RIG_COUNT] = {"nose_gear", "main_gear", "hook", "nose_gear",
                                                "main_gear"};

// --- measured curves --------------------------------------------------------------------------

/// One reading of measured curves: where they go, and what is said of them.
typedef struct curve_reading {
    bt_reader* reader;
    const bt_study_files* files;
    const char* key; ///< "rigs.nose_drop.reference.curve"
    bt_rig_input* input;
} curve_reading;

/// A text that outlives the reading; NULL when memory is out, or for NULL.
static const char* keep(bt_document* names, const bt_node* node) {
    const bt_node* kept =
        node ? bt_document_node(names, BT_NODE_SCALAR, BT_NOWHERE, node->text, strlen(node->text))
             : NULL;
    return kept ? kept->text : NULL;
}

static void add_curve(const curve_reading* r, const bt_node* file,
                      const bt_measured_columns* columns) {
    bt_rig_input* input = r->input;
    if (input->curve_count == BT_CURVES_MAX) {
        bt_reader_error(r->reader, file->where, "%s: more than %d curves", r->key,
                        (int)BT_CURVES_MAX);
        return;
    }
    const char* path = bt_study_file(r->reader, r->files, file, r->key);
    if (!path)
        return;
    input->curves[input->curve_count].path = path;
    input->curves[input->curve_count].columns = *columns;
    input->curves[input->curve_count++].where = file->where;
}

static bool is_text(const bt_node* node) {
    return node && node->kind == BT_NODE_SCALAR && *node->text;
}

/// `x: Time` is the time; `x: {stroke: Stroke}` names the history's column.
static bool take_x(bt_reader* reader, bt_document* names, const bt_node* x, const char* key,
                   bt_measured_columns* columns) {
    columns->x_name = "time";
    if (!x)
        return true;
    const bt_node* heading = x->kind == BT_NODE_MAPPING && x->count == 1 ? x->first : x;
    if (!is_text(heading)) {
        bt_reader_error(
            reader, x->where,
            "%s.x: the heading of a column is wanted here, as in x: Time, or x: {stroke: "
            "Stroke}",
            key);
        return false;
    }
    columns->x_heading = keep(names, heading);
    if (heading != x)
        columns->x_name = keep(names, heading->key);
    return true;
}

static void take_y(bt_document* names, const bt_node* y, bt_measured_columns* columns) {
    columns->y_name = keep(names, y->key);
    columns->y_heading = keep(names, y);
}

/// What a mapping says but its y: columns, and the file in *file. False after reporting an error.
static bool take_mapping(bt_reader* reader, bt_document* names, const bt_node* node,
                         const char* key, const bt_node** file, bt_measured_columns* columns) {
    static const char* const known[] = {"file", "x", "y", "offset", NULL};
    const bt_node *y = bt_node_child(node, "y"), *offset = bt_node_child(node, "offset");
    const int before = reader->errors;
    *columns = (bt_measured_columns){.where = node->where, .offset = keep(names, offset)};
    *file = bt_node_child(node, "file");
    bt_reader_known_keys(reader, node, key, known, NULL);
    if (!is_text(*file))
        bt_reader_error(reader, node->where, "%s.file: missing; the name of a CSV file is wanted",
                        key);
    if (y && y->kind != BT_NODE_MAPPING)
        bt_reader_error(reader, y->where,
                        "%s.y: columns are wanted here by their name in the history, as in y: "
                        "{stroke: Stroke, strut_force: Load cell}",
                        key);
    take_x(reader, names, bt_node_child(node, "x"), key, columns);
    if (!y)
        columns->x_name = NULL; // the headings are the history's names
    return reader->errors == before;
}

bool bt_curve_take(bt_reader* reader, bt_document* names, const bt_node* node, const char* key,
                   const bt_node** file, bt_measured_columns* columns) {
    *file = node;
    *columns = (bt_measured_columns){.where = node->where};
    if (node->kind != BT_NODE_MAPPING)
        return is_text(node);
    if (!take_mapping(reader, names, node, key, file, columns))
        return false;
    const bt_node* y = bt_node_child(node, "y");
    if (y && y->count != 1) {
        bt_reader_error(reader, y->where, "%s.y: one column is wanted here", key);
        return false;
    }
    if (y)
        take_y(names, y->first, columns);
    return true;
}

/// {file: drop.csv, x: Time, y: {stroke: Stroke, strut_force: Load cell}, offset: 12.4 ms}: a curve
/// for each y.
static void take_curves(const curve_reading* r, const bt_node* node) {
    const bt_node *file, *y = bt_node_child(node, "y");
    bt_measured_columns columns;
    if (!take_mapping(r->reader, r->files->names, node, r->key, &file, &columns))
        return;
    if (!y)
        add_curve(r, file, &columns);
    for (const bt_node* one = y ? y->first : NULL; one; one = one->next) {
        take_y(r->files->names, one, &columns);
        add_curve(r, file, &columns);
    }
}

static void take_curve(const curve_reading* r, const bt_node* node) {
    if (node->refused)
        return;
    if (node->kind == BT_NODE_MAPPING)
        take_curves(r, node);
    else if (is_text(node))
        add_curve(r, node, &(bt_measured_columns){.where = node->where});
    else
        bt_reader_error(r->reader, node->where,
                        "%s: the name of a CSV file is wanted here, a mapping with file, x, y and "
                        "offset, or a sequence of such",
                        r->key);
}

/// A key that is not there gets a value; the place is its mapping's.
static void fill(bt_document* document, bt_node* mapping, const char* key, const char* value) {
    if (!mapping || mapping->kind != BT_NODE_MAPPING || bt_node_child(mapping, key))
        return;
    bt_node* name = bt_document_node(document, BT_NODE_SCALAR, mapping->where, key, strlen(key));
    bt_node* node =
        bt_document_node(document, BT_NODE_SCALAR, mapping->where, value, strlen(value));
    if (name && node)
        bt_node_append(mapping, name, node);
}

void bt_rig_inputs_take(bt_reader* reader, const bt_study_files* files, bt_node* root,
                        bt_study* study) {
    const bt_node* rigs = bt_node_child(root, "rigs");
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind) {
        bt_rig_input* input = &study->rig_inputs[kind];
        bt_node* rig = bt_node_child(rigs, bt_rig_keys[kind]);
        input->given = rig != NULL;
        if (bt_node_child(rig, "drop_height"))
            fill(files->names, rig, "sink_speed", "0 m/s");
        const bt_node* curve = bt_node_take(bt_node_child(rig, "reference"), "curve");
        if (!curve)
            continue;
        char key[64];
        snprintf(key, sizeof key, "rigs.%s.reference.curve", bt_rig_keys[kind]);
        const curve_reading r = {reader, files, key, input};
        if (curve->kind != BT_NODE_SEQUENCE)
            take_curve(&r, curve);
        else
            for (const bt_node* one = curve->first; one; one = one->next)
                take_curve(&r, one);
    }
}

// --- files that describe rigs only ------------------------------------------------------------

bool bt_rig_inputs_alone(const bt_node* root) {
    return bt_node_child(root, "rigs") && !bt_node_child(root, "deck") &&
           !bt_node_child(root, "landing");
}

/// A length that says where a part stands: 0 where it is not given.
static void place_at_origin(bt_document* document, bt_node* part, const char* key) {
    fill(document, part, key, "0 m");
}

/// A spring that is no gas needs none of the gas's keys, and no oil where no orifice is given.
static void fill_spring(bt_document* document, bt_node* oleo) {
    const bt_node* spring = bt_node_child(oleo, "spring");
    if (!spring || strcmp(spring->text, "points") != 0)
        return;
    fill(document, oleo, "air_area", "0 m^2");
    fill(document, oleo, "precharge", "0 Pa");
    fill(document, oleo, "air_volume", "0 m^3");
    if (!bt_node_child(oleo, "orifice_area") && !bt_node_child(oleo, "orifice_table"))
        fill(document, oleo, "oil_area", "0 m^2");
}

/// What hangs on a strut plays no part on the press.
static void fill_wheel(bt_document* document, bt_node* part) {
    fill(document, part, "piston_mass", "1 kg");
    fill(document, part, "wheel_mass", "1 kg");
    fill(document, part, "wheel_inertia", "1 kg m^2");
    if (part->kind != BT_NODE_MAPPING || bt_node_child(part, "tyre"))
        return;
    bt_node* name = bt_document_node(document, BT_NODE_SCALAR, part->where, "tyre", 4);
    bt_node* tyre = bt_document_node(document, BT_NODE_MAPPING, part->where, "", 0);
    if (!name || !tyre)
        return;
    bt_node_append(part, name, tyre);
    fill(document, tyre, "radius", "1 m");
    fill(document, tyre, "width", "1 m");
}

/// Without a drop of the leg only its strut is tested, whose oil may be left out.
static void fill_strut(bt_document* document, const bt_node* root, bt_node* part, bool nose) {
    const bt_node* rigs = bt_node_child(root, "rigs");
    bt_node* oleo = bt_node_child(part, "oleo");
    fill_spring(document, oleo);
    if (bt_node_child(rigs, bt_rig_keys[nose ? BT_RIG_NOSE_DROP : BT_RIG_MAIN_DROP]) ||
        !bt_node_child(rigs, bt_rig_keys[nose ? BT_RIG_NOSE_STATIC : BT_RIG_MAIN_STATIC]))
        return;
    fill_wheel(document, part);
    if (!bt_node_child(oleo, "orifice_area") && !bt_node_child(oleo, "orifice_table"))
        fill(document, oleo, "oil_area", "0 m^2");
}

static void read_part(bt_reader* reader, bt_document* document, const bt_node* root, bt_node* part,
                      int kind, bt_aircraft_params* aircraft) {
    char path[64];
    bt_reader_join(path, sizeof path, "aircraft", parts[kind]);
    if (kind == BT_RIG_HOOK_REBOUND) {
        place_at_origin(document, part, "pivot_x");
        place_at_origin(document, part, "pivot_z");
        bt_reader_group(reader, &bt_hook_group, &aircraft->hook, path, part, NULL);
        return;
    }
    place_at_origin(document, part, "station");
    place_at_origin(document, part, "half_track");
    place_at_origin(document, part, "underside");
    fill_strut(document, root, part, bt_rig_is_nose((bt_rig_kind)kind));
    bt_reader_group(reader, &bt_gear_group,
                    bt_rig_is_nose((bt_rig_kind)kind) ? &aircraft->nose_gear : &aircraft->main_gear,
                    path, part, NULL);
}

void bt_rig_inputs_read_parts(bt_reader* reader, bt_document* document, bt_node* root,
                              bt_study* study) {
    static const char* const chapters[] = {"title", "aircraft", "rigs", NULL};
    static const char* const known[] = {"nose_gear", "main_gear", "hook", NULL};
    bt_aircraft_params* model = &study->model.aircraft;
    bt_node* aircraft = bt_node_child(root, "aircraft");
    study->rigs_only = true;
    if (!bt_reader_is_mapping(reader, root, ""))
        return;
    bt_reader_known_keys(reader, root, "", chapters, NULL);
    if (bt_node_child(aircraft, "mass")) { // a whole aircraft
        bt_reader_group(reader, &bt_aircraft_group, model, "aircraft", aircraft, NULL);
        return;
    }
    if (aircraft && bt_reader_is_mapping(reader, aircraft, "aircraft"))
        bt_reader_known_keys(reader, aircraft, "aircraft", known, NULL);
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind) {
        bt_node* part = bt_node_child(aircraft, parts[kind]);
        const bt_node* rig = bt_node_child(bt_node_child(root, "rigs"), bt_rig_keys[kind]);
        if (part && kind <= BT_RIG_HOOK_REBOUND) // the static rigs share the legs of the drops
            read_part(reader, document, root, part, kind, model);
        else if (part)
            continue;
        else if (rig)
            bt_reader_error(reader, rig->key->where, "aircraft.%s: missing; rigs.%s tests it",
                            parts[kind], bt_rig_keys[kind]);
    }
}

// --- together ---------------------------------------------------------------------------------

/// A press that goes on after the gas is gone.
static void check_press(bt_reader* reader, const bt_node* rigs, int kind, const bt_study* study) {
    const bool nose = bt_rig_is_nose((bt_rig_kind)kind);
    const bt_aircraft_params* a = &study->model.aircraft;
    const double stroke = (nose ? study->rigs.nose_static : study->rigs.main_static).stroke_m;
    const bt_node* node = bt_node_child(bt_node_child(rigs, bt_rig_keys[kind]), "stroke");
    if (!node)
        return;
    bt_oleo oleo;
    bt_gear_prepare_oleo(nose ? &a->nose_gear : &a->main_gear, &oleo);
    if (!isfinite(bt_oleo_gas_force(&oleo, stroke)))
        bt_reader_error(reader, node->where, "rigs.%s.stroke: no gas volume is left at %g m",
                        bt_rig_keys[kind], stroke);
}

void bt_rig_inputs_check(bt_reader* reader, const bt_node* root, const bt_study* study) {
    const bt_aircraft_params* aircraft = &study->model.aircraft;
    const bt_node* rigs = bt_node_child(root, "rigs");
    for (int kind = 0; kind < BT_RIG_HOOK_REBOUND; ++kind) {
        const bool nose = kind == BT_RIG_NOSE_DROP;
        const bt_gear_params* gear = nose ? &aircraft->nose_gear : &aircraft->main_gear;
        const double mass = nose ? study->rigs.nose_drop.mass_kg : study->rigs.main_drop.mass_kg;
        const double unsprung = gear->piston_mass_kg + gear->wheel_mass_kg;
        const bt_node* node = bt_node_child(bt_node_child(rigs, bt_rig_keys[kind]), "mass");
        if (node && mass <= unsprung)
            bt_reader_error(reader, node->where,
                            "rigs.%s.mass: %g kg is not above that of piston and wheel, %g kg",
                            bt_rig_keys[kind], mass, unsprung);
    }
    for (int kind = BT_RIG_NOSE_STATIC; kind <= BT_RIG_MAIN_STATIC; ++kind)
        check_press(reader, rigs, kind, study);
}

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"
#include "calibration/simulated_case.h"
#include "study/reader.h"
#include "study/rig_inputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACE_SIZE = 256 };

/// One reading.
typedef struct reading {
    bt_reader reader;
    bt_document document;
    bt_calibration* c;
    bt_status status; ///< what is no fault of the file: memory
} reading;

// --- paths and values -------------------------------------------------------------------------

/// A field of numbers named by a key; NULL after reporting an error.
static const bt_field* find_field(reading* r, const bt_node* key, const char* path,
                                  size_t* offset) {
    const bt_field* field = bt_parameter_set_find(&r->c->base, key->text, offset);
    if (field && field->kind <= BT_FIELD_COUNT && strlen(key->text) < BT_PATH_MAX)
        return field;
    if (field) {
        bt_reader_error(&r->reader, key->where, "%s.%s: a key that holds one number is wanted",
                        path, key->text);
        return NULL;
    }
    const bt_text_nearest nearest = bt_parameter_set_nearest(&r->c->base, key->text);
    bt_reader_error(&r->reader, key->where, "%s.%s: no such key; did you mean \"%s\"?", path,
                    key->text, nearest.name);
    return NULL;
}

/// A number with the unit of a token, of any size.
static bool read_quantity(reading* r, const bt_node* node, const char* token, const char* path,
                          double* value) {
    const bt_field any = {.kind = BT_FIELD_REAL, .name = path, .unit = token};
    return bt_reader_number(&r->reader, &any, node, path, false, value);
}

/// "5 %" gives 0.05 and *relative; anything else is a quantity of the token. Above zero.
static bool read_tolerance(reading* r, const bt_node* node, const char* token, const char* path,
                           double* value, bool* relative) {
    *relative = false;
    if (node->kind == BT_NODE_SCALAR) {
        const char* end = bt_text_scan_number(node->text, value);
        while (*end == ' ')
            ++end;
        *relative = end != node->text && strcmp(end, "%") == 0;
        *value /= 100;
    }
    if (!*relative && !read_quantity(r, node, token, path, value))
        return false;
    if (*value > 0 && isfinite(*value))
        return true;
    bt_reader_error(&r->reader, node->where, "%s: must be above 0", path);
    return false;
}

static void keep_text(char* text, size_t size, const bt_node* node) {
    snprintf(text, size, "%s", node->kind == BT_NODE_SCALAR ? node->text : "");
}

// --- parameters -------------------------------------------------------------------------------

static void read_bounds(reading* r, bt_parameter* p, const bt_node* node, const char* path) {
    char place[PLACE_SIZE];
    double* const value[] = {&p->lower, &p->upper, &p->start};
    static const char* const names[] = {"lower", "upper", "start"};
    for (int i = 0; i < 3; ++i) {
        const bt_node* child = bt_node_child(node, names[i]);
        bt_reader_join(place, sizeof place, path, names[i]);
        if (child && bt_reader_number(&r->reader, p->field, child, place, true, value[i]))
            keep_text(p->typed, sizeof p->typed, child);
        else if (!child && i < 2)
            bt_reader_error(&r->reader, node->where, "%s: missing; the bounds say what is possible",
                            place);
    }
    const bt_node* spread = bt_node_child(node, "spread");
    bt_reader_join(place, sizeof place, path, "spread");
    if (spread && bt_reader_number(&r->reader, p->field, spread, place, false, &p->spread) &&
        !(p->spread > 0))
        bt_reader_error(&r->reader, spread->where, "%s: must be above 0", place);
}

static void read_parameter(reading* r, const bt_node* node) {
    static const char* const keys[] = {"lower", "upper", "start", "spread", NULL};
    bt_calibration* c = r->c;
    char path[PLACE_SIZE];
    size_t offset;
    const bt_field* field = find_field(r, node->key, "parameters", &offset);
    snprintf(path, sizeof path, "parameters.%s", node->key->text);
    if (!field || !bt_reader_is_mapping(&r->reader, node, path))
        return;
    if (c->parameter_count == BT_PARAMETER_MAX) {
        bt_reader_error(&r->reader, node->key->where, "parameters: more than %d", BT_PARAMETER_MAX);
        return;
    }
    const int errors = r->reader.errors;
    bt_parameter* p = &c->parameters[c->parameter_count++];
    *p = (bt_parameter){.field = field, .offset = offset};
    snprintf(p->path, sizeof p->path, "%s", node->key->text);
    p->start = bt_field_get(field, &c->base, offset);
    bt_reader_known_keys(&r->reader, node, path, keys, NULL);
    read_bounds(r, p, node, path);
    if (r->reader.errors > errors)
        return;
    if (!(p->lower < p->upper))
        bt_reader_error(&r->reader, node->key->where, "%s: lower is not below upper", path);
    else if (!(p->start >= p->lower && p->start <= p->upper))
        bt_reader_error(&r->reader, node->key->where,
                        "%s: the start (or, without one, the study's value) is not between the "
                        "bounds",
                        path);
}

static void read_parameters(reading* r, const bt_node* node, const bt_node* root) {
    if (!node || node->count == 0) {
        bt_reader_error(&r->reader, node ? node->where : root->where,
                        "parameters: missing; wanted: the keys to identify, as in "
                        "aircraft.hook.down_stop: {lower: 50 deg, upper: 80 deg}");
        return;
    }
    if (!bt_reader_is_mapping(&r->reader, node, "parameters"))
        return;
    for (const bt_node* child = node->first; child; child = child->next)
        read_parameter(r, child);
}

// --- simulated cases
// ------------------------------------------------------------------------------

/// Reads `under`, a mapping of paths and values, into a simulated case; false after errors.
static bool read_overrides(reading* r, const bt_node* node, const char* path,
                           bt_simulated_case* e) {
    if (!node)
        return true;
    if (!bt_reader_is_mapping(&r->reader, node, path))
        return false;
    bool good = true;
    for (const bt_node* child = node->first; child; child = child->next) {
        bt_override o;
        char place[PLACE_SIZE];
        snprintf(place, sizeof place, "%s.%s", path, child->key->text);
        o.field = find_field(r, child->key, path, &o.offset);
        if (!o.field || !bt_reader_number(&r->reader, o.field, child, place, true, &o.value))
            good = false;
        else if (e->override_count == BT_OVERRIDE_MAX) {
            bt_reader_error(&r->reader, child->where, "%s: more than %d", path, BT_OVERRIDE_MAX);
            return false;
        } else
            e->overrides[e->override_count++] = o;
    }
    return good;
}

static bool same_case(const bt_simulated_case* a, const bt_simulated_case* b) {
    if (a->kind != b->kind || a->override_count != b->override_count)
        return false;
    for (int i = 0; i < a->override_count; ++i)
        if (a->overrides[i].offset != b->overrides[i].offset ||
            a->overrides[i].value != b->overrides[i].value)
            return false;
    return true;
}

/// The number of a simulated case, shared with an equal one; -1 when there is no more room.
static int add_case(bt_calibration* c, const bt_simulated_case* e) {
    for (int i = 0; i < c->case_count; ++i)
        if (same_case(&c->cases[i], e))
            return i;
    if (c->case_count == BT_CASE_MAX)
        return -1;
    c->cases[c->case_count] = *e;
    return c->case_count++;
}

/// Adds the simulated case of a target, or one per value of its trend.
static void add_cases(reading* r, bt_target* t, const bt_simulated_case* e, const bt_node* node,
                      const bt_override* over, const double* values, int count) {
    for (int i = 0; i < count; ++i) {
        bt_simulated_case one = *e;
        if (over) {
            one.overrides[one.override_count] = *over;
            one.overrides[one.override_count++].value = values[i];
        }
        t->cases[i] = add_case(r->c, &one);
        if (t->cases[i] < 0) {
            bt_reader_error(&r->reader, node->where, "targets: more than %d simulated cases",
                            BT_CASE_MAX);
            return;
        }
        t->case_count = i + 1;
    }
}

// --- targets ----------------------------------------------------------------------------------

/// Finds "bounce_height" or "nose_drop.stroke_max"; false after reporting an error.
static bool find_metric(reading* r, const bt_node* node, const char* path, bt_target* t,
                        bt_simulated_case_kind* kind) {
    bt_text_nearest nearest = bt_text_search(node->text);
    char names[BT_CASE_METRIC_MAX * BT_CASE_KINDS][64], help[160];
    int count = 0;
    for (int k = BT_CASE_LANDING; k < BT_CASE_KINDS; ++k) {
        const int room = bt_simulated_case_metric_count((bt_simulated_case_kind)k);
        for (int i = 0; i < room; ++i) {
            bt_metric_name metric;
            if (!bt_simulated_case_metric((bt_simulated_case_kind)k, i, &metric))
                continue;
            char* name = names[count++];
            snprintf(name, sizeof names[0], "%s%s",
                     bt_simulated_case_prefix((bt_simulated_case_kind)k), metric.name);
            if (strcmp(name, node->text) == 0) {
                t->metric = i;
                t->token = metric.token;
                *kind = (bt_simulated_case_kind)k;
                return true;
            }
            bt_text_look(&nearest, name);
        }
    }
    bt_text_suggest(&nearest, help, sizeof help);
    if (strcmp(node->text, "impact_force") == 0) // its name up to 0.1
        snprintf(help, sizeof help, "; did you mean \"bounce_impact_force\"?");
    bt_reader_error(
        &r->reader, node->where, "%s.metric: \"%.60s\" is no metric%s", path, node->text,
        *help ? help : "; as in bounce_height, throat_force_peak or nose_drop.stroke_max");
    return false;
}

/// Says what a target is in a report: metric and circumstances.
static void name_target(bt_target* t, const bt_node* metric, const bt_node* under,
                        const bt_node* over) {
    snprintf(t->name, sizeof t->name, "%s", metric->text);
    for (const bt_node* child = under ? under->first : NULL; child; child = child->next)
        bt_text_append(t->name, sizeof t->name, ", %s %s", child->key->text, child->text);
    if (over)
        bt_text_append(t->name, sizeof t->name, " over %s", over->text);
}

static void read_wanted(reading* r, bt_target* t, const bt_node* node, const bt_node* value,
                        const char* path) {
    char place[PLACE_SIZE];
    keep_text(t->typed, sizeof t->typed, value);
    snprintf(place, sizeof place, "%s.%s", path, value->key->text);
    read_quantity(r, value, t->token, place, &t->wanted);
    const bt_node* tolerance = bt_node_child(node, "tolerance");
    snprintf(place, sizeof place, "%s.tolerance", path);
    if (!tolerance)
        bt_reader_error(&r->reader, node->where,
                        "%s: missing; wanted: what the value is good for, "
                        "as in 5 %% or 2 mm",
                        place);
    else if (read_tolerance(r, tolerance, t->token, place, &t->tolerance, &t->relative) &&
             t->relative && t->wanted == 0)
        bt_reader_error(&r->reader, tolerance->where,
                        "%s: a share of 0 is nothing; write it with "
                        "a unit",
                        place);
}

/// The values of a trend: `over` names the key, `values` are what it takes.
static int read_trend_values(reading* r, const bt_node* node, const bt_node* over, const char* path,
                             bt_override* override, double* values) {
    char place[PLACE_SIZE];
    int count = 0;
    const bt_node* list = bt_node_child(node, "values");
    snprintf(place, sizeof place, "%s.values", path);
    override->field = find_field(r, over, path, &override->offset);
    if (!list || list->kind != BT_NODE_SEQUENCE || list->count < 2 || list->count > BT_LIST_MAX) {
        bt_reader_error(&r->reader, list ? list->where : node->where,
                        "%s: a sequence of 2 to %d values is wanted", place, (int)BT_LIST_MAX);
        return 0;
    }
    for (const bt_node* item = list->first; item && override->field; item = item->next)
        if (bt_reader_number(&r->reader, override->field, item, place, true, &values[count]))
            ++count;
    return count == list->count ? count : 0;
}

/// A metric that grows, falls or stays while a key takes several values.
static void read_trend(reading* r, bt_target* t, const bt_node* node, const bt_node* trend,
                       bt_simulated_case* e, const char* path) {
    static const char* const names[] = {"increasing", "decreasing", "constant", NULL};
    char place[PLACE_SIZE];
    double values[BT_LIST_MAX];
    bt_override override;
    int choice = 0;
    const bt_node* over = bt_node_child(node, "over");
    const bt_node* tolerance = bt_node_child(node, "tolerance");
    snprintf(place, sizeof place, "%s.trend", path);
    if (bt_reader_choice(&r->reader, names, trend, place, &choice))
        t->kind = (bt_target_kind)(BT_TARGET_INCREASING + choice);
    if (!over || over->kind != BT_NODE_SCALAR || !tolerance) {
        bt_reader_error(&r->reader, node->where,
                        "%s: a trend wants `over` (a key), `values` and "
                        "`tolerance` (the least change, or for constant "
                        "the greatest)",
                        path);
        return;
    }
    snprintf(place, sizeof place, "%s.tolerance", path);
    read_tolerance(r, tolerance, t->token, place, &t->tolerance, &t->relative);
    if (e->override_count == BT_OVERRIDE_MAX) {
        bt_reader_error(&r->reader, over->where, "%s: with `over`, more than %d keys differ", path,
                        BT_OVERRIDE_MAX);
        return;
    }
    const int count = read_trend_values(r, node, over, path, &override, values);
    add_cases(r, t, e, node, &override, values, count);
    t->row_count = count > 0 ? count - 1 : 0;
}

/// Reads the CSV of a curve, beside the calibration file, and finds its columns.
static void read_curve(reading* r, bt_target* t, const bt_node* file,
                       const bt_measured_columns* columns, const bt_simulated_case* e) {
    char path[BT_FILE_PATH_MAX];
    bt_calibration* c = r->c;
    const char* slash = strrchr(c->file_name, '/');
    const int folder = slash && *file->text != '/' ? (int)(slash - c->file_name) + 1 : 0;
    snprintf(path, sizeof path, "%.*s%s", folder, c->file_name, file->text);
    // a node of the document: messages name the file until they are handed on
    const bt_node* name =
        bt_document_node(&r->document, BT_NODE_SCALAR, BT_NOWHERE, path, strlen(path));
    if (!name) {
        r->status = BT_ERR_MEMORY;
        return;
    }
    bt_diag diag = bt_reader_diag(&r->reader);
    const int errors = r->reader.errors;
    bt_status status = bt_measured_read(name->text, columns, &t->measured, &diag);
    if (status == BT_OK) {
        status = bt_simulated_case_bind(e->kind, t->measured, &diag);
        t->row_count = t->measured->count;
    }
    if (status == BT_ERR_MEMORY)
        r->status = status;
    else if (status != BT_OK && r->reader.errors == errors)
        bt_reader_error(&r->reader, file->where, "%s: cannot be used: %s", file->text,
                        bt_status_text(status));
}

/// `curve: FILE.csv`, or a mapping of its columns, with `of`: landing or one of the rigs.
static void read_curve_target(reading* r, bt_target* t, const bt_node* node, const bt_node* curve,
                              bt_simulated_case* e, const char* path) {
    static const char* const kinds[] = {"landing",     "nose_drop",   "main_drop", "hook_rebound",
                                        "nose_static", "main_static", NULL};
    char place[PLACE_SIZE];
    const bt_node* of = bt_node_child(node, "of");
    const bt_node* tolerance = bt_node_child(node, "tolerance");
    int kind = 0;
    t->kind = BT_TARGET_CURVE;
    t->token = "1";
    snprintf(place, sizeof place, "%s.of", path);
    if (of && bt_reader_choice(&r->reader, kinds, of, place, &kind))
        e->kind = (bt_simulated_case_kind)kind;
    const bt_node* file;
    bt_measured_columns columns;
    const int errors = r->reader.errors;
    char key[PLACE_SIZE];
    snprintf(key, sizeof key, "%s.curve", path);
    const bool named = bt_curve_take(&r->reader, &r->document, curve, key, &file, &columns);
    if (!named && r->reader.errors > errors)
        return;
    if (!of || !tolerance || !named) {
        bt_reader_error(&r->reader, node->where,
                        "%s: a curve wants `of` (landing or a rig) and "
                        "`tolerance`",
                        path);
        return;
    }
    snprintf(t->name, sizeof t->name, "%s of %s", file->text, kinds[kind]);
    read_curve(r, t, file, &columns, e);
    if (!t->measured)
        return;
    char unit[48];
    snprintf(unit, sizeof unit, "1 %s", t->measured->y_unit);
    snprintf(t->typed, sizeof t->typed, "%s", unit);
    t->token = t->measured->y_token;
    snprintf(place, sizeof place, "%s.tolerance", path);
    read_tolerance(r, tolerance, t->token, place, &t->tolerance, &t->relative);
    add_cases(r, t, e, node, NULL, NULL, 1);
}

/// A target that compares one metric.
static void read_metric_target(reading* r, bt_target* t, const bt_node* node, bt_simulated_case* e,
                               const char* path) {
    static const char* const wishes[] = {"value", "at_most", "at_least"};
    const bt_node* metric = bt_node_child(node, "metric");
    const bt_node* trend = bt_node_child(node, "trend");
    int wished = trend != NULL;
    if (!metric || metric->kind != BT_NODE_SCALAR) {
        bt_reader_error(&r->reader, node->where, "%s: `metric` (or `curve`) is missing", path);
        return;
    }
    name_target(t, metric, bt_node_child(node, "under"), bt_node_child(node, "over"));
    if (!find_metric(r, metric, path, t, &e->kind))
        return;
    t->row_count = 1;
    for (int i = 0; i < 3; ++i) {
        const bt_node* value = bt_node_child(node, wishes[i]);
        if (!value)
            continue;
        ++wished;
        t->kind = (bt_target_kind)(BT_TARGET_VALUE + i);
        read_wanted(r, t, node, value, path);
        add_cases(r, t, e, node, NULL, NULL, 1);
    }
    if (wished != 1)
        bt_reader_error(&r->reader, node->where,
                        "%s: one of `value`, `at_most`, `at_least` and `trend` is wanted", path);
    else if (trend)
        read_trend(r, t, node, trend, e, path);
}

static void read_target(reading* r, const bt_node* node, int number) {
    static const char* const keys[] = {"metric",    "under",  "value",  "at_most", "at_least",
                                       "trend",     "over",   "values", "curve",   "of",
                                       "tolerance", "weight", NULL};
    bt_calibration* c = r->c;
    char path[64], place[PLACE_SIZE];
    snprintf(path, sizeof path, "targets[%d]", number);
    if (!bt_reader_is_mapping(&r->reader, node, path))
        return;
    if (c->target_count == BT_TARGET_MAX) {
        bt_reader_error(&r->reader, node->where, "targets: more than %d", BT_TARGET_MAX);
        return;
    }
    bt_target* t = &c->targets[c->target_count++];
    *t = (bt_target){.weight = 1, .where = node->where, .first_row = c->row_count};
    t->where.file = c->file_name;
    bt_reader_known_keys(&r->reader, node, path, keys, NULL);
    bt_simulated_case e = {0};
    snprintf(place, sizeof place, "%s.under", path);
    if (!read_overrides(r, bt_node_child(node, "under"), place, &e))
        return;
    const bt_node* weight = bt_node_child(node, "weight");
    snprintf(place, sizeof place, "%s.weight", path);
    if (weight && read_quantity(r, weight, "1", place, &t->weight) && !(t->weight > 0))
        bt_reader_error(&r->reader, weight->where, "%s: must be above 0", place);
    const bt_node* curve = bt_node_child(node, "curve");
    const int errors = r->reader.errors;
    if (curve)
        read_curve_target(r, t, node, curve, &e, path);
    else
        read_metric_target(r, t, node, &e, path);
    if (c->rigs_only && e.kind == BT_CASE_LANDING && r->reader.errors == errors)
        bt_reader_error(&r->reader, node->where, "%s: the study describes rigs and no landing",
                        path);
    c->row_count += t->row_count;
}

static void read_targets(reading* r, const bt_node* node, const bt_node* root) {
    if (!node || node->kind != BT_NODE_SEQUENCE || node->count == 0) {
        bt_reader_error(&r->reader, node ? node->where : root->where,
                        "targets: a sequence is wanted, as in - {metric: bounce_height, value: "
                        "53 mm, tolerance: 5 %%}");
        return;
    }
    int number = 1;
    for (const bt_node* item = node->first; item; item = item->next)
        read_target(r, item, number++);
}

// --- file -------------------------------------------------------------------------------------

static void read_whole(reading* r, const bt_node* root, const char* name, int least, int most,
                       int* value) {
    const bt_field field = {.kind = BT_FIELD_COUNT, .least = least, .greatest = most};
    const bt_node* node = bt_node_child(root, name);
    double number;
    if (node && bt_reader_number(&r->reader, &field, node, name, true, &number))
        *value = (int)number;
}

static void read_root(reading* r, const bt_node* root) {
    static const char* const keys[] = {"parameters", "targets", "under", "steps", "starts", NULL};
    bt_simulated_case common = {0};
    if (!bt_reader_is_mapping(&r->reader, root, "calibration"))
        return;
    bt_reader_known_keys(&r->reader, root, "", keys, NULL);
    read_whole(r, root, "steps", 1, BT_STEPS_MAX, &r->c->steps);
    read_whole(r, root, "starts", 1, 1000, &r->c->starts);
    if (read_overrides(r, bt_node_child(root, "under"), "under", &common))
        for (int i = 0; i < common.override_count; ++i)
            bt_field_set(common.overrides[i].field, &r->c->base, common.overrides[i].offset,
                         common.overrides[i].value);
    read_parameters(r, bt_node_child(root, "parameters"), root);
    read_targets(r, bt_node_child(root, "targets"), root);
}

/// The study's model with the cable far enough for undisturbed bounces.
static void set_base(bt_calibration* c, const bt_study* study) {
    c->base.model = study->model;
    c->base.rigs = study->rigs;
    c->rigs_only = study->rigs_only;
    if (c->base.model.landing.distance_m < BT_CLEAR_DISTANCE_M)
        c->base.model.landing.distance_m = BT_CLEAR_DISTANCE_M;
}

static bt_status read_text(reading* r, const char* text, size_t size) {
    bt_node* root = NULL;
    bt_diag diag = bt_reader_diag(&r->reader);
    const bt_where where = {r->c->file_name, 1, 1};
    const bt_status status = bt_document_parse(&r->document, text, size, where, &root, &diag);
    if (status == BT_OK && !root)
        bt_reader_error(&r->reader, where, "the file is empty");
    else if (status == BT_OK)
        read_root(r, root);
    return status == BT_OK && r->status != BT_OK ? r->status : status;
}

bt_status bt_calibration_read(const char* path, const bt_study* study, bt_calibration* calibration,
                              bt_diag* diag) {
    char* text = NULL;
    size_t size = 0;
    *calibration = (bt_calibration){.steps = 30, .starts = 1};
    calibration->threads = (int)study->campaign.threads;
    BT_TRY(bt_file_read(path, &text, &size, diag));
    reading* r = calloc(1, sizeof *r);
    calibration->file_name = strdup(path);
    bt_status status = BT_ERR_MEMORY;
    if (r && calibration->file_name) {
        r->c = calibration;
        set_base(calibration, study);
        status = read_text(r, text, size);
        if (status == BT_OK && r->reader.errors > 0)
            status = BT_ERR_INPUT;
        bt_reader_flush(&r->reader, diag);
        bt_document_destroy(&r->document);
    }
    free(r);
    free(text);
    if (status != BT_OK)
        bt_calibration_destroy(calibration);
    return status;
}

void bt_calibration_destroy(bt_calibration* calibration) {
    for (int i = 0; i < calibration->target_count; ++i)
        bt_measured_destroy(calibration->targets[i].measured);
    free(calibration->file_name);
    calibration->target_count = 0;
    calibration->file_name = NULL;
}

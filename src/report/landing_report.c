#include "report/landing_report.h"

#include "base/units.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const char* hook_loads(const bt_landing_result* result) {
    return result->shank_bends ? "uncalibrated, shank bends" : "uncalibrated, rigid shank";
}

// --- JSON: a member per row -----------------------------------------------------------------

#define JSON_REAL(json, from, name, unit)                                                          \
    bt_json_number(json, #name "_" #unit, (from)->name##_##unit);
#define JSON_FLAG(json, from, name, unit) bt_json_bool(json, #name, (from)->name);
#define JSON_COUNT(json, from, name, unit) bt_json_integer(json, #name, (from)->name);
#define JSON_OUTCOME(json, from, name, unit)                                                       \
    bt_json_string(json, #name, bt_outcome_name((from)->name));
#define JSON_MODE(json, from, name, unit) bt_json_string(json, #name, bt_mode_name((from)->name));
#define JSON_LEGS(json, from, name, unit) json_legs(json, #name "_" #unit, (from)->name##_##unit);
#define JSON_BOUNCES(json, from, name, unit) json_bounces(json, #name, from);
#define JSON_CONTACTS(json, from, name, unit) json_contacts(json, #name, from);
#define JSON_REMARKS(json, from, name, unit) json_remarks(json, #name, &(from)->name);
#define JSON_FAILURE(json, from, name, unit)                                                       \
    json_failure(json, #name, (from)->name##_element, (from)->name##_quantity,                     \
                 (from)->name##_time_s);
#define JSON_HASH(json, from, name, unit) json_hash(json, #name, (from)->name);

static void json_legs(bt_json* json, const char* key, const double* value) {
    bt_json_begin_object(json, key);
    for (int i = 0; i < BT_LEG_COUNT; ++i)
        bt_json_number(json, bt_leg_names[i], value[i]);
    bt_json_end_object(json);
}

#define JSON_OF_BOUNCE(KIND, name, unit, label, shown, text) JSON_##KIND(json, bounce, name, unit)

static void json_bounces(bt_json* json, const char* key, const bt_landing_result* result) {
    bt_json_begin_array(json, key);
    for (int i = 0; i < result->bounce_count && i < BT_BOUNCE_MAX; ++i) {
        const bt_bounce* bounce = &result->bounces[i];
        bt_json_begin_object(json, NULL);
        BT_BOUNCE_FIELDS(JSON_OF_BOUNCE)
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

#define JSON_OF_CONTACT(KIND, name, unit, label, shown, text) JSON_##KIND(json, contact, name, unit)

static void json_contacts(bt_json* json, const char* key, const bt_landing_result* result) {
    bt_json_begin_array(json, key);
    for (int i = 0; i < result->contact_count; ++i) {
        const bt_contact* contact = &result->contacts[i];
        bt_json_begin_object(json, NULL);
        BT_CONTACT_FIELDS(JSON_OF_CONTACT)
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static void json_remarks(bt_json* json, const char* key, const bt_remarks* remarks) {
    bt_json_begin_array(json, key);
    for (int i = 0; i < BT_REMARK_COUNT; ++i) {
        if (!bt_remarks_has(remarks, (bt_remark)i))
            continue;
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "what", bt_remark_table[i].what);
        bt_json_string(json, "element", bt_remark_table[i].element);
        bt_json_number(json, "time_s", remarks->time_s[i]);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

/// A member of failed runs only.
static void json_failure(bt_json* json, const char* key, const char* element, const char* quantity,
                         double time_s) {
    if (!*element)
        return;
    bt_json_begin_object(json, key);
    bt_json_string(json, "element", element);
    bt_json_string(json, "quantity", quantity);
    bt_json_number(json, "time_s", time_s);
    bt_json_end_object(json);
}

static void json_hash(bt_json* json, const char* key, uint64_t hash) {
    char text[24];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    bt_json_string(json, key, text);
}

#define JSON_OF_LANDING(KIND, name, unit, label, shown, text) JSON_##KIND(json, result, name, unit)

void bt_landing_write_json(bt_json* json, const bt_landing_result* result) {
    bt_json_begin_object(json, NULL);
    BT_LANDING_RESULT_FIELDS(JSON_OF_LANDING)
    bt_json_string(json, "hook_loads", hook_loads(result));
    if (result->outcome == BT_ENGAGED)
        bt_json_number(json, "engaged_loads_valid_s", BT_ENGAGED_LOADS_VALID_S);
    bt_json_end_object(json);
}

// --- text: a line per row that has a label --------------------------------------------------

/// SI to the unit that is shown ("mm" of "m").
static double in_unit(double value, const char* unit, const char* shown) {
    char one[16], why[128];
    double factor = 1;
    snprintf(one, sizeof one, "1 %s", shown);
    return bt_unit_parse(one, unit, &factor, why, sizeof why) == BT_OK ? value / factor : value;
}

/// What is added to the number of a row, in parentheses; NULL for most.
static const char* note_of(const char* name, const bt_landing_result* result) {
    if (strcmp(name, "margin") == 0)
        return "cable above lip when they meet; positive catches";
    if (strcmp(name, "hook_deck_force_peak") == 0)
        return hook_loads(result);
    return NULL;
}

static void text_real(FILE* out, const bt_landing_result* result, const char* name, double value,
                      const char* unit, const char* label, const char* shown) {
    const char* note = note_of(name, result);
    if (*label && isfinite(value))
        fprintf(out, "%-14s %.4g %s%s%s%s\n", label, in_unit(value, unit, shown), shown,
                note ? " (" : "", note ? note : "", note ? ")" : "");
}

static void text_flag(FILE* out, const bt_landing_result* result, bool value, const char* label) {
    if (*label && result->outcome == BT_ENGAGED)
        fprintf(out, "%-14s %s\n", label, value ? "yes, to the end of the run" : "no, lost again");
}

static void text_legs(FILE* out, const double* value, const char* unit, const char* label,
                      const char* shown) {
    fprintf(out, "%-14s ", label);
    for (int i = 0; i < BT_LEG_COUNT; ++i)
        fprintf(out, "%s%s %.4g", i ? ", " : "", bt_leg_names[i], in_unit(value[i], unit, shown));
    fprintf(out, " %s\n", shown);
}

static void text_bounces(FILE* out, const bt_landing_result* result) {
    for (int i = 0; i < result->bounce_count && i < BT_BOUNCE_MAX; ++i) {
        const bt_bounce* bounce = &result->bounces[i];
        fprintf(out, "bounce %-2d      %.1f mm high, %.2f m long, impact %.0f kN%s\n", i + 1,
                1e3 * bounce->height_m, bounce->distance_m, 1e-3 * bounce->impact_force_N,
                bounce->complete ? "" : " (the run ended in the air)");
    }
}

/// On a deck with one wire the other lines say it all.
static void text_contacts(FILE* out, const bt_landing_result* result) {
    const bt_contact* last = result->contacts + result->contact_count - 1;
    if (result->contact_count == 0 || last->wire == 1)
        return;
    for (const bt_contact* c = result->contacts; c <= last; ++c) {
        fprintf(out, "wire %-2lld        %s: %s", (long long)c->wire, bt_mode_name(c->mode),
                bt_mode_text(c->mode));
        if (isfinite(c->margin_m))
            fprintf(out, ", margin %.2f mm", 1e3 * c->margin_m);
        fprintf(out, ", at %.4f s\n", c->time_s);
    }
}

static void text_remarks(FILE* out, const bt_remarks* remarks) {
    for (int i = 0; i < BT_REMARK_COUNT; ++i)
        if (bt_remarks_has(remarks, (bt_remark)i))
            fprintf(out, "remark         %s: %s, at %.4g s\n", bt_remark_table[i].element,
                    bt_remark_table[i].text, remarks->time_s[i]);
}

static void text_outcome(FILE* out, const bt_landing_result* result) {
    if (result->outcome == BT_FAILED)
        fprintf(out, "outcome        failed: %s, %s, at %.6g s\n", result->failed_element,
                result->failed_quantity, result->failed_time_s);
    else
        fprintf(out, "outcome        %s, %s: %s\n", bt_outcome_name(result->outcome),
                bt_mode_name(result->mode), bt_mode_text(result->mode));
}

#define TEXT_REAL(name, unit, label, shown)                                                        \
    text_real(out, result, #name, result->name##_##unit, #unit, label, #shown);
#define TEXT_FLAG(name, unit, label, shown) text_flag(out, result, result->name, label);
#define TEXT_LEGS(name, unit, label, shown)                                                        \
    text_legs(out, result->name##_##unit, #unit, label, #shown);
#define TEXT_OUTCOME(name, unit, label, shown) text_outcome(out, result);
#define TEXT_BOUNCES(name, unit, label, shown) text_bounces(out, result);
#define TEXT_CONTACTS(name, unit, label, shown) text_contacts(out, result);
#define TEXT_REMARKS(name, unit, label, shown) text_remarks(out, &result->name);
#define TEXT_MODE(name, unit, label, shown)    /* said with the outcome */
#define TEXT_COUNT(name, unit, label, shown)   /* said at the end */
#define TEXT_FAILURE(name, unit, label, shown) /* said with the outcome */
#define TEXT_HASH(name, unit, label, shown)    /* for programs */
#define TEXT_OF_LANDING(KIND, name, unit, label, shown, text) TEXT_##KIND(name, unit, label, shown)

void bt_landing_print(FILE* out, const bt_landing_result* result) {
    BT_LANDING_RESULT_FIELDS(TEXT_OF_LANDING)
    if (result->outcome == BT_ENGAGED)
        fprintf(out,
                "loads          of an engaged hook hold for %.0f ms after the catch: no arresting "
                "engine pays out\n",
                1e3 * BT_ENGAGED_LOADS_VALID_S);
    fprintf(
        out,
        "ended          %.3f s %s first contact, computed in %.0f ms (%lld airframe steps, %lld "
        "cable steps)\n",
        fabs(result->end_time_s), result->end_time_s < 0 ? "before" : "after", 1e3 * result->wall_s,
        (long long)result->steps, (long long)result->cable_steps);
}

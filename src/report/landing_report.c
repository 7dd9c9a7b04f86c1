#include "report/landing_report.h"

#include <inttypes.h>
#include <math.h>

static const char* const leg_names[BT_LEG_COUNT] = {"nose", "left", "right"};

static void write_legs(bt_json* json, const char* key, const double* value) {
    bt_json_begin_object(json, key);
    for (int i = 0; i < BT_LEG_COUNT; ++i)
        bt_json_number(json, leg_names[i], value[i]);
    bt_json_end_object(json);
}

static void write_bounces(bt_json* json, const bt_landing_result* result) {
    bt_json_begin_array(json, "bounces");
    for (int i = 0; i < result->bounce_count && i < BT_BOUNCE_MAX; ++i) {
        const bt_bounce* bounce = &result->bounces[i];
        bt_json_begin_object(json, NULL);
        bt_json_number(json, "height_m", bounce->height_m);
        bt_json_number(json, "distance_m", bounce->distance_m);
        bt_json_number(json, "impact_force_N", bounce->impact_force_N);
        bt_json_bool(json, "complete", bounce->complete);
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
}

static const char* hook_loads(const bt_landing_result* result) {
    return result->shank_bends ? "uncalibrated, shank bends" : "uncalibrated, rigid shank";
}

void bt_landing_write_json(bt_json* json, const bt_landing_result* result) {
    char hash[24];
    snprintf(hash, sizeof hash, "%016" PRIx64, result->state_hash);
    bt_json_begin_object(json, NULL);
    bt_json_string(json, "outcome", bt_outcome_name(result->outcome));
    bt_json_string(json, "mode", bt_mode_name(result->mode));
    bt_json_bool(json, "retained", result->retained);
    bt_json_number(json, "margin_m", result->margin_m);
    bt_json_number(json, "throat_force_peak_N", result->throat_force_peak_N);
    bt_json_number(json, "time_of_contact_s", result->time_of_contact_s);
    write_bounces(json, result);
    bt_json_number(json, "hook_deck_force_peak_N", result->hook_deck_force_peak_N);
    bt_json_string(json, "hook_loads", hook_loads(result));
    if (result->outcome == BT_ENGAGED)
        bt_json_number(json, "engaged_loads_valid_s", BT_ENGAGED_LOADS_VALID_S);
    write_legs(json, "strut_stroke_max_m", result->strut_stroke_max_m);
    write_legs(json, "tyre_force_max_N", result->tyre_force_max_N);
    bt_json_number(json, "cable_tension_max_N", result->cable_tension_max_N);
    bt_json_integer(json, "steps", result->steps);
    bt_json_integer(json, "cable_steps", result->cable_steps);
    bt_json_number(json, "end_time_s", result->end_time_s);
    bt_json_number(json, "wall_s", result->wall_s);
    bt_json_string(json, "state_hash", hash);
    if (result->outcome == BT_FAILED) {
        bt_json_begin_object(json, "failed");
        bt_json_string(json, "element", result->failed_element);
        bt_json_string(json, "quantity", result->failed_quantity);
        bt_json_number(json, "time_s", result->failed_time_s);
        bt_json_end_object(json);
    }
    bt_json_end_object(json);
}

/// What a mode says to someone who meets it for the first time.
static const char* explain(bt_mode mode) {
    switch (mode) {
    case BT_MODE_DIRECT:
        return "the cable went straight into the throat";
    case BT_MODE_ARM:
        return "the cable slid down the arm into the throat";
    case BT_MODE_BOUNCED_OVER:
        return "the hook had bounced and crossed clear above the cable";
    case BT_MODE_PASSED_OVER:
        return "the hook crossed clear above the cable before it touched the deck";
    case BT_MODE_RIDDEN_OVER:
        return "the point touched the cable and went over it";
    default:
        return "";
    }
}

static void print_outcome(FILE* out, const bt_landing_result* result) {
    if (result->outcome == BT_FAILED) {
        fprintf(out, "outcome        failed: %s, %s, at %.6g s\n", result->failed_element,
                result->failed_quantity, result->failed_time_s);
        return;
    }
    fprintf(out, "outcome        %s, %s: %s\n", bt_outcome_name(result->outcome),
            bt_mode_name(result->mode), explain(result->mode));
    if (isfinite(result->margin_m))
        fprintf(out, "margin         %+.1f mm (cable above lip when they meet; positive catches)\n",
                1e3 * result->margin_m);
    fprintf(out, "throat force   %.1f kN peak%s\n", 1e-3 * result->throat_force_peak_N,
            result->outcome != BT_ENGAGED ? ""
            : result->retained            ? ", cable still held at the end"
                                          : ", cable lost again");
}

void bt_landing_print(FILE* out, const bt_landing_result* result) {
    print_outcome(out, result);
    for (int i = 0; i < result->bounce_count && i < BT_BOUNCE_MAX; ++i) {
        const bt_bounce* bounce = &result->bounces[i];
        fprintf(out, "bounce %-2d      %.1f mm high, %.2f m long, impact %.0f kN%s\n", i + 1,
                1e3 * bounce->height_m, bounce->distance_m, 1e-3 * bounce->impact_force_N,
                bounce->complete ? "" : " (the run ended in the air)");
    }
    fprintf(out, "hook on deck   %.0f kN peak (%s)\n", 1e-3 * result->hook_deck_force_peak_N,
            hook_loads(result));
    fprintf(out, "strut stroke   nose %.0f, left %.0f, right %.0f mm\n",
            1e3 * result->strut_stroke_max_m[BT_LEG_NOSE],
            1e3 * result->strut_stroke_max_m[BT_LEG_LEFT],
            1e3 * result->strut_stroke_max_m[BT_LEG_RIGHT]);
    fprintf(out, "tyre force     nose %.0f, left %.0f, right %.0f kN\n",
            1e-3 * result->tyre_force_max_N[BT_LEG_NOSE],
            1e-3 * result->tyre_force_max_N[BT_LEG_LEFT],
            1e-3 * result->tyre_force_max_N[BT_LEG_RIGHT]);
    fprintf(out, "cable tension  %.1f kN peak\n", 1e-3 * result->cable_tension_max_N);
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

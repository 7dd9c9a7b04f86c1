#include "report/json.h"

#include "base/text.h"

#include <math.h>

/// "<" could end the script element that holds the data of a page.
static void write_char(const bt_json* json, char c) {
    if (c == '<' && json->in_page)
        fputs("\\u003c", json->out);
    else
        fputc(c, json->out);
}

static void write_string(const bt_json* json, const char* text) {
    FILE* out = json->out;
    fputc('"', out);
    for (; *text; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else if (c == '\n')
            fputs("\\n", out);
        else if (c < 0x20)
            fprintf(out, "\\u%04x", c);
        else
            write_char(json, *text);
    }
    fputc('"', out);
}

static void indent(const bt_json* json) {
    if (json->in_page)
        return;
    fputc('\n', json->out);
    for (int i = 0; i < json->depth; ++i)
        fputs("  ", json->out);
}

/// What stands before a value: comma, line, key.
static void lead_in(bt_json* json, const char* key) {
    if (json->depth > 0) {
        bool* filled = &json->filled[json->depth - 1];
        if (*filled)
            fputc(',', json->out);
        *filled = true;
        indent(json);
    }
    if (key) {
        write_string(json, key);
        fputs(": ", json->out);
    }
}

static void begin(bt_json* json, const char* key, char bracket) {
    lead_in(json, key);
    fputc(bracket, json->out);
    if (json->depth < BT_JSON_DEPTH_MAX)
        json->filled[json->depth++] = false;
}

static void end(bt_json* json, char bracket) {
    const bool filled = json->depth > 0 && json->filled[--json->depth];
    if (filled)
        indent(json);
    fputc(bracket, json->out);
    if (json->depth == 0)
        fputc('\n', json->out);
}

void bt_json_begin_object(bt_json* json, const char* key) {
    begin(json, key, '{');
}

void bt_json_end_object(bt_json* json) {
    end(json, '}');
}

void bt_json_begin_array(bt_json* json, const char* key) {
    begin(json, key, '[');
}

void bt_json_end_array(bt_json* json) {
    end(json, ']');
}

void bt_json_number(bt_json* json, const char* key, double value) {
    char text[40] = "null";
    lead_in(json, key);
    if (isfinite(value))
        bt_text_print_number(value, text, sizeof text);
    fputs(text, json->out);
}

void bt_json_integer(bt_json* json, const char* key, int64_t value) {
    lead_in(json, key);
    fprintf(json->out, "%lld", (long long)value);
}

void bt_json_bool(bt_json* json, const char* key, bool value) {
    lead_in(json, key);
    fputs(value ? "true" : "false", json->out);
}

void bt_json_string(bt_json* json, const char* key, const char* value) {
    lead_in(json, key);
    if (value)
        write_string(json, value);
    else
        fputs("null", json->out);
}

void bt_json_rounded(bt_json* json, const char* key, double value, int digits) {
    char text[40] = "null";
    lead_in(json, key);
    if (isfinite(value))
        bt_text_print_rounded(value, digits, text, sizeof text);
    fputs(text, json->out);
}

void bt_json_text(bt_json* json, const char* key, const char* text) {
    lead_in(json, key);
    for (; *text; ++text)
        write_char(json, *text);
}

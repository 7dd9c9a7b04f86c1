#include "base/directory.h"
#include "bolter/version.h"
#include "report/page_parts.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH = 16, SOURCE_SIZE = 400 };

/// A key of the study file with its value and the comment that stands behind it.
typedef struct source {
    char path[2 * BT_PATH_MAX], value[128], comment[SOURCE_SIZE];
} source;

/// Reading the lines of one file: the keys above the present line, by indentation.
typedef struct scan {
    bt_page* page;
    int depth;
    int indent[DEPTH];
    char key[DEPTH][BT_PATH_MAX];
    source last; ///< not written yet: the comment may go on in the next line
} scan;

static void put(scan* s) {
    bt_json* json = s->page->json;
    if (s->last.comment[0]) {
        bt_json_begin_object(json, NULL);
        bt_json_string(json, "path", s->last.path);
        bt_json_string(json, "value", s->last.value);
        bt_json_string(json, "source", s->last.comment);
        bt_json_end_object(json);
    }
    s->last = (source){0};
}

/// Copies text without blanks at its ends.
static void copy_trimmed(char* to, size_t size, const char* from, size_t length) {
    while (length > 0 && isspace((unsigned char)*from)) {
        ++from;
        --length;
    }
    while (length > 0 && isspace((unsigned char)from[length - 1]))
        --length;
    snprintf(to, size, "%.*s", (int)length, from);
}

/// Where the comment of a line begins: a '#' after a blank; its end when there is none.
static const char* comment_of(const char* line) {
    for (const char* c = line; *c; ++c)
        if (*c == '#' && (c == line || isspace((unsigned char)c[-1])))
            return c;
    return line + strlen(line);
}

static void join(const scan* s, char* path, size_t size) {
    path[0] = '\0';
    for (int i = 0; i < s->depth; ++i) {
        const size_t used = strlen(path);
        snprintf(path + used, size - used, "%s%s", i ? "." : "", s->key[i]);
    }
}

static void read_key(scan* s, const char* line, int indent, const char* colon, const char* end) {
    while (s->depth > 0 && s->indent[s->depth - 1] >= indent)
        --s->depth;
    if (s->depth == DEPTH)
        return;
    s->indent[s->depth] = indent;
    copy_trimmed(s->key[s->depth], sizeof s->key[0], line + indent,
                 (size_t)(colon - line - indent));
    ++s->depth;
    join(s, s->last.path, sizeof s->last.path);
    copy_trimmed(s->last.value, sizeof s->last.value, colon + 1, (size_t)(end - colon - 1));
    if (*end && s->last.value[0])
        copy_trimmed(s->last.comment, sizeof s->last.comment, end + 1, strlen(end + 1));
}

static void read_line(scan* s, const char* line) {
    const int indent = (int)strspn(line, " ");
    const char* end = comment_of(line);
    const char* colon = strchr(line, ':');
    if (line[indent] == '#' && indent > 8 && s->last.comment[0]) { // the comment above goes on
        char more[SOURCE_SIZE];
        copy_trimmed(more, sizeof more, end + 1, strlen(end + 1));
        const size_t used = strlen(s->last.comment);
        snprintf(s->last.comment + used, sizeof s->last.comment - used, " %s", more);
        return;
    }
    put(s);
    if (colon && colon < end)
        read_key(s, line, indent, colon, end);
}

/// A file that stands for a part of the study: its keys belong under `prefix`.
static void scan_file(bt_page* page, const char* path, const char* prefix);

/// Files that the study names for its aircraft and deck.
static void scan_named(bt_page* page, const char* path, const char* text) {
    static const char* const parts[] = {"aircraft", "deck"};
    for (size_t i = 0; i < 2; ++i) {
        char mark[32], name[256], file[BT_FILE_PATH_MAX];
        snprintf(mark, sizeof mark, "\n%s:", parts[i]);
        const char* at = strstr(text, mark);
        if (!at)
            continue;
        at += strlen(mark);
        copy_trimmed(name, sizeof name, at, strcspn(at, "#\n"));
        const char* slash = strrchr(path, '/');
        snprintf(file, sizeof file, "%.*s%s", slash ? (int)(slash - path + 1) : 0, path, name);
        if (name[0])
            scan_file(page, file, parts[i]);
    }
}

static void scan_file(bt_page* page, const char* path, const char* prefix) {
    char* text = NULL;
    if (bt_file_read(path, &text, NULL, NULL) != BT_OK)
        return;
    scan s = {.page = page};
    if (*prefix) {
        s.depth = 1;
        s.indent[0] = -1;
        snprintf(s.key[0], sizeof s.key[0], "%s", prefix);
    } else
        scan_named(page, path, text);
    char* rest = text;
    for (char* line = strsep(&rest, "\n"); line; line = strsep(&rest, "\n"))
        read_line(&s, line);
    put(&s);
    free(text);
}

static void write_commands(bt_page* page) {
    static const char* const verbs[] = {"study", "report"};
    char line[BT_FILE_PATH_MAX];
    bt_json_begin_array(page->json, "commands");
    for (size_t i = 0; i < sizeof verbs / sizeof verbs[0]; ++i) {
        snprintf(line, sizeof line, "bolter %s %s", verbs[i], page->subject->file);
        bt_json_string(page->json, NULL, line);
    }
    snprintf(line, sizeof line, "bolter replay %s N    # a landing of the campaign, to the bit",
             page->subject->file);
    bt_json_string(page->json, NULL, line);
    bt_json_end_array(page->json);
}

void bt_page_study_write(bt_page* page) {
    const bt_study* study = page->subject->study;
    bt_json* json = page->json;
    char hash[24];
    bt_json_begin_array(json, "sources");
    scan_file(page, page->subject->file, "");
    bt_json_end_array(json);
    bt_json_begin_object(json, "study");
    bt_json_string(json, "file", page->subject->file);
    bt_json_string(json, "text", study->text);
    write_commands(page);
    bt_json_end_object(json);
    snprintf(hash, sizeof hash, "%016" PRIx64, study->hash);
    bt_json_begin_object(json, "versions");
    bt_json_string(json, "bolter", bt_version());
    bt_json_string(json, "built with", page->subject->build);
    bt_json_string(json, "hash of the study's model and design", hash);
    bt_json_end_object(json);
}

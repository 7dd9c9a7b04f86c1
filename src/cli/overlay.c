#include "cli/overlay.h"

#include "base/directory.h"

#include <stdlib.h>
#include <string.h>

/// Cuts blanks at both ends, and a comment: a # at the beginning or after a blank.
static char* strip(char* line) {
    for (char* c = line; *c; ++c)
        if (*c == '#' && (c == line || c[-1] == ' ' || c[-1] == '\t')) {
            *c = '\0';
            break;
        }
    line += strspn(line, " \t\r");
    size_t length = strlen(line);
    while (length > 0 && strchr(" \t\r", line[length - 1]))
        line[--length] = '\0';
    return line;
}

/// Adds "PATH: VALUE" as PATH=VALUE; the text goes into the command's own memory.
static const char* add_line(bt_command* command, const char* line) {
    const char* colon = strstr(line, ": ");
    if (!colon || colon == line)
        return "a line PATH: VALUE is wanted, as in aircraft.hook.down_stop: 70 deg";
    if (command->set_count == BT_SETS_MAX)
        return "too many values are set";
    const char* value = colon + 1 + strspn(colon + 1, " ");
    const size_t room = sizeof command->overlay - command->overlay_used;
    const size_t used = (size_t)(colon - line) + 1 + strlen(value) + 1;
    if (used > room)
        return "the files of --set are too long";
    char* set = command->overlay + command->overlay_used;
    snprintf(set, room, "%.*s=%s", (int)(colon - line), line, value);
    command->overlay_used += used;
    command->sets[command->set_count++] = set;
    return NULL;
}

bt_status bt_overlay_read(bt_command* command, const char* file) {
    char* text = NULL;
    bt_diag diag = bt_stderr_diag();
    BT_TRY(bt_file_read(file, &text, NULL, &diag));
    int number = 0;
    char* start = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text; // byte order mark
    for (char *line = start, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        ++number;
        line = strip(line);
        const char* fault = *line ? add_line(command, line) : NULL;
        if (fault)
            bt_diag_add(&diag, BT_ERROR, (bt_where){file, number, 1}, "%s", fault);
    }
    free(text);
    return diag.errors > 0 ? BT_ERR_INPUT : BT_OK;
}

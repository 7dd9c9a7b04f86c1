#include "cli/output.h"

#include "base/directory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const struct {
    const char *suffix, *text;
    int kind;
} kinds[] = {
    {".h5", "FILE.h5 (time histories)", BT_OUTPUT_HISTORIES},
    {".csv", "FILE.csv (table or histories)", BT_OUTPUT_TABLE},
    {".yaml", "FILE.yaml (the values found)", BT_OUTPUT_VALUES},
    {".html", "FILE.html (page for a browser)", BT_OUTPUT_PAGE},
    {".pvd", "FILE.pvd (for ParaView)", BT_OUTPUT_PARAVIEW},
    {".bolter", "FILE.bolter (the whole study)", BT_OUTPUT_CAPSULE},
    {NULL, "a directory", BT_OUTPUT_DIRECTORY},
};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

int bt_output_kind(const char* output) {
    struct stat info;
    if (!output || !*output)
        return BT_OUTPUT_NONE;
    if (stat(output, &info) == 0 && S_ISDIR(info.st_mode))
        return BT_OUTPUT_DIRECTORY;
    const char* slash = strrchr(output, '/');
    const char* name = slash ? slash + 1 : output;
    const char* dot = strrchr(name, '.');
    if (!*name || !dot || dot == name)
        return BT_OUTPUT_DIRECTORY;
    for (int i = 0; i < KIND_COUNT; ++i)
        if (kinds[i].suffix && strcmp(dot, kinds[i].suffix) == 0)
            return kinds[i].kind;
    return BT_OUTPUT_NONE;
}

static bool same_file(const struct stat* a, const char* path) {
    struct stat b;
    return stat(path, &b) == 0 && a->st_dev == b.st_dev && a->st_ino == b.st_ino;
}

/// Whether -o names a file that the command line names as input, by whatever name.
static bool is_input(const bt_command* command) {
    struct stat output;
    if (stat(command->output, &output) != 0 || S_ISDIR(output.st_mode))
        return false;
    for (int i = 0; i < command->word_count; ++i)
        if (same_file(&output, command->words[i]))
            return true;
    for (int i = 0; i < command->set_file_count; ++i)
        if (same_file(&output, command->set_files[i]))
            return true;
    return false;
}

static bt_status refuse_input(const bt_command* command) {
    return bt_usage_error(command, "-o: %s is read by this command and would be lost",
                          command->output);
}

bt_status bt_output_check(const bt_command* command, int accepted) {
    if (!command->output)
        return BT_OK;
    if (accepted == BT_OUTPUT_NONE)
        return bt_usage_error(command, "writes no files; take what it prints: bolter %s ... > FILE",
                              command->verb->name);
    if (!*command->output || strlen(command->output) >= sizeof((bt_study*)0)->directory)
        return bt_usage_error(command, "-o: the name is %s",
                              *command->output ? "too long" : "empty");
    if (is_input(command))
        return refuse_input(command);
    if (bt_output_kind(command->output) & accepted)
        return BT_OK;
    char possible[256] = "";
    for (int i = 0; i < KIND_COUNT; ++i)
        if (kinds[i].kind & accepted) {
            const size_t used = strlen(possible);
            snprintf(possible + used, sizeof possible - used, "%s%s", used ? ", " : "",
                     kinds[i].text);
        }
    return bt_usage_error(command, "-o: cannot write \"%s\"; what it can write: %s",
                          command->output, possible);
}

bt_status bt_output_spare(const bt_command* command, const bt_study* study) {
    if (command->output && bt_output_kind(command->output) != BT_OUTPUT_DIRECTORY &&
        bt_study_reads(study, command->output))
        return refuse_input(command);
    return BT_OK;
}

bt_status bt_output_path(const bt_command* command, const char* name, char* path, bt_diag* diag) {
    if (bt_output_kind(command->output) != BT_OUTPUT_DIRECTORY) {
        snprintf(path, BT_FILE_PATH_MAX, "%s", command->output);
        return BT_OK;
    }
    BT_TRY(bt_directory_make(command->output, diag));
    return bt_file_path(path, command->output, name);
}

bt_status bt_output_table(const bt_command* command, const bt_report_table* table, bt_diag* diag) {
    if (bt_output_kind(command->output) != BT_OUTPUT_TABLE)
        return BT_OK;
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    bt_status status = bt_report_table_csv(table, out);
    if (fclose(out) != 0 && status == BT_OK)
        status = BT_ERR_MEMORY;
    // the names of its columns are the mark of a table that Bolter wrote
    if (status == BT_OK)
        status = bt_file_replace(command->output, text, size, strcspn(text, "\n") + 1, diag);
    free(text);
    return status;
}

#include "cli/example.h"

#include "base/text.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { FOLDER_MAX = 4096 };

/// Beside the program: where studies are installed, and where they are in the source tree.
static const char* const folders[] = {"../share/bolter/studies", "../studies"};
enum { FOLDER_COUNT = sizeof folders / sizeof folders[0] };

static bool program_folder(char folder[FOLDER_MAX]) {
    const ssize_t length = readlink("/proc/self/exe", folder, FOLDER_MAX - 1);
    if (length <= 0)
        return false;
    folder[length] = '\0';
    char* slash = strrchr(folder, '/');
    if (slash)
        *slash = '\0';
    return slash != NULL;
}

static bool find(bt_command* command, const char* program) {
    static const char* const forms[] = {"%s/%s/%s/study.yaml", "%s/%s/%s.yaml"};
    for (int i = 0; i < FOLDER_COUNT; ++i)
        for (size_t k = 0; k < sizeof forms / sizeof forms[0]; ++k) {
            const int length = snprintf(command->example_file, sizeof command->example_file,
                                        forms[k], program, folders[i], command->example);
            if (length < (int)sizeof command->example_file &&
                access(command->example_file, R_OK) == 0)
                return true;
        }
    return false;
}

/// ", reference" of ".../studies/reference/study.yaml".
static void append_name(char* list, size_t size, const char* path, size_t folder) {
    const char* name = path + folder + 1;
    const char* end = strstr(name, "/study.yaml");
    if (!end)
        end = strstr(name, ".yaml");
    if (end)
        bt_text_append(list, size, "%s%.*s", *list ? ", " : "", (int)(end - name), name);
}

/// The names that there are; "none" where nothing is installed.
static void list_names(const char* program, char* list, size_t size) {
    char pattern[FOLDER_MAX + 64];
    *list = '\0';
    for (int i = 0; i < FOLDER_COUNT && !*list; ++i) {
        glob_t found = {0};
        const int folder = snprintf(pattern, sizeof pattern, "%s/%s", program, folders[i]);
        snprintf(pattern + folder, sizeof pattern - (size_t)folder, "/*/study.yaml");
        glob(pattern, 0, NULL, &found);
        snprintf(pattern + folder, sizeof pattern - (size_t)folder, "/rigs/*.yaml");
        glob(pattern, GLOB_APPEND, NULL, &found);
        for (size_t k = 0; k < found.gl_pathc; ++k)
            append_name(list, size, found.gl_pathv[k], (size_t)folder);
        globfree(&found);
    }
    if (!*list)
        snprintf(list, size, "none is installed beside the program");
}

/// Where the verb expects the study: behind a word that one of its forms begins with, else first.
static int study_place(const bt_command* command) {
    char form[128];
    if (command->word_count == 0)
        return 0;
    snprintf(form, sizeof form, "\n%s STUDY.yaml", command->words[0]);
    return strstr(command->verb->arguments, form) ? 1 : 0;
}

bool bt_example_take(bt_command* command) {
    char program[FOLDER_MAX], names[1024];
    const bool placed = program_folder(program);
    if (!placed || strstr(command->example, "..") || !find(command, program)) {
        list_names(placed ? program : "", names, sizeof names);
        bt_usage_error(command, "--example: there is no \"%s\"; there are: %s", command->example,
                       names);
        return false;
    }
    if (command->word_count == command->verb->most_words ||
        !strstr(command->verb->arguments, "STUDY.yaml")) {
        bt_usage_error(command,
                       "--example stands in the place of STUDY.yaml: one argument too many");
        return false;
    }
    const int place = study_place(command);
    memmove(command->words + place + 1, command->words + place,
            (size_t)(command->word_count - place) * sizeof command->words[0]);
    command->words[place] = command->example_file;
    ++command->word_count;
    return true;
}

/// A study made in memory, and a directory that goes away after the test.
#ifndef BT_TESTS_TOY_STUDY_H
#define BT_TESTS_TOY_STUDY_H

#include "folder.h"
#include "study/study.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/// Adds an input with bounds and a normal distribution inside them.
static inline void toy_input(bt_study* study, const char* path, double lower, double upper) {
    bt_input* input = &study->inputs[study->input_count++];
    snprintf(input->path, sizeof input->path, "%s", path);
    input->field = bt_group_find(&bt_model_group, path, &input->offset);
    input->bounded = input->random = true;
    input->lower = lower;
    input->upper = upper;
    input->distribution = (bt_distribution){
        .kind = BT_NORMAL, .mean = 0.5 * (lower + upper), .sd = 0.1 * (upper - lower)};
}

/// The default model with the paper's four inputs.
static inline void toy_study(bt_study* study, int design, int samples) {
    memset(study, 0, sizeof *study);
    bt_group_set_defaults(&bt_model_group, &study->model);
    bt_group_set_defaults(&bt_campaign_group, &study->campaign);
    study->campaign.design = design;
    study->campaign.samples = samples;
    study->campaign.seed = 11;
    toy_input(study, "landing.sink_speed", 2, 6);
    toy_input(study, "landing.horizontal_speed", 40, 55);
    toy_input(study, "landing.pitch", 0, 0.14);
    toy_input(study, "landing.distance", 2, 10);
    study->text = (char*)"title: toy\n";
}

/// A new directory for one test; free the name after toy_directory_remove.
static inline char* toy_directory(void) {
    char* path = malloc(FOLDER_SIZE);
    assert_int_equal(folder_make(path), 0);
    return path;
}

static inline int toy_remove_one(const char* path, const struct stat* info, int kind,
                                 struct FTW* place) {
    (void)info;
    (void)kind;
    (void)place;
    return remove(path);
}

static inline void toy_directory_remove(char* path) {
    nftw(path, toy_remove_one, 16, FTW_DEPTH | FTW_PHYS);
    free(path);
}

/// "DIRECTORY/NAME" in a buffer of 4096 bytes.
static inline const char* toy_path(char* buffer, const char* directory, const char* name) {
    snprintf(buffer, 4096, "%s/%s", directory, name);
    return buffer;
}

/// A sink that keeps the last message.
typedef struct toy_messages {
    char last[1024], file[4096];
} toy_messages;

static inline void toy_keep(void* user, bt_severity severity, bt_where where, const char* text) {
    toy_messages* messages = user;
    (void)severity;
    snprintf(messages->last, sizeof messages->last, "%s", text);
    snprintf(messages->file, sizeof messages->file, "%s", where.file ? where.file : "");
}

static inline bt_diag toy_diag(toy_messages* messages) {
    *messages = (toy_messages){"", ""};
    return (bt_diag){.sink = toy_keep, .user = messages};
}

#endif

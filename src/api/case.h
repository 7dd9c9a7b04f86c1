/// What is behind the public handle of a study.
#ifndef BT_API_CASE_H
#define BT_API_CASE_H

#include "bolter/study.h"

#include "bolter/landing.h"
#include "surrogate/surrogate.h"

#include <string.h>

/// Where the study came from: it is read anew when a text is set.
typedef enum bt_case_source { BT_CASE_FILE, BT_CASE_RIGS, BT_CASE_TEXT } bt_case_source;

struct bt_case {
    bt_study study;
    bt_lander* lander; ///< runs bt_case_land; created with the case
    bt_case_source source;
    char *name, *text; ///< file or name; the text of BT_CASE_TEXT. Owned
    int set_count;
    char** sets; ///< [set_count] "PATH=VALUE", owned
    bt_message* message;
    void* user;
    bool landed;            ///< last holds a landing
    bt_landing_result last; ///< result of the latest bt_case_land
    bool fitted;            ///< surrogate holds one
    bt_surrogate surrogate; ///< surrogate of the latest bt_case_fit
};

/// Copies what a caller of any version has filled in of a definition that begins with its size; the
/// rest is zero. False: the size is missing.
#define BT_DEF_COPY(to, from) bt_def_copy(&(to), sizeof(to), (from), (from)->size)

static inline bool bt_def_copy(void* to, size_t known, const void* from, size_t size) {
    memset(to, 0, known);
    memcpy(to, from, size < known ? size : known);
    return size >= sizeof size;
}

/// The public report of a landing, as much of it as the caller knows. False: its size is missing.
bool bt_case_report(const bt_landing_result* result, bt_landing_report* report);

/// Hands a view of a landing to a public watcher.
struct bt_landing_view;
void bt_case_show_line(const struct bt_landing_view* view, bt_landing_watch* watch, void* user);

/// A numeric key of the model by its path; NULL when there is none, which is said in diag.
const bt_field* bt_case_number(const bt_case* c, const char* path, size_t* offset, bt_diag* diag);

/// A result that is a number, by its name; NULL when there is none.
const bt_result_column* bt_case_column(const char* name);
double bt_case_column_value(const bt_result_column* column, const bt_landing_result* result);

/// Diagnostics that reach the case's message function as finished lines.
bt_diag bt_case_diag(const bt_case* opened);

#endif

/// A study in memory: opened from a file, from a text, or from the defaults; every key read and
/// changed by its path.
///
/// Thread rules, for the whole interface: a case belongs to one thread at a time; several cases may
/// be used at once. The library never prints, never exits and has no mutable globals. Numbers are
/// SI: m, kg, s, rad, N, Pa. Nothing that a function is given is kept unless it says so.
#ifndef BOLTER_STUDY_H
#define BOLTER_STUDY_H

#include "bolter/status.h"
#include "bolter/version.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Receives what is wrong, one message at a time, already with its place
/// ("study.yaml:12:7: error: ..."). The text is valid during the call only.
typedef void bt_message(void* user, const char* text);

/// A study opened for work. Opaque; release with bt_case_close.
typedef struct bt_case bt_case;

/// Reads and checks a study file.
///
/// @param path       the file
/// @param sets       [set_count] texts "PATH=VALUE" with units, as --set on the command line; NULL
///                   when set_count is 0
/// @param message    receives every mistake, now and in later calls with this case; NULL to drop
///                   them. Kept, with user, until bt_case_close
/// @param opened     the case on BT_OK, NULL otherwise
/// @return BT_OK; BT_ERR_INPUT (rejected), BT_ERR_IO (unreadable), BT_ERR_MEMORY
BT_PUBLIC BT_CHECKED bt_status bt_case_open(const char* path, const char* const* sets,
                                            int set_count, bt_message* message, void* user,
                                            bt_case** opened);

/// The same for a YAML text in memory; `name` stands for the file in messages and names the study
/// directory. Other files cannot be named in the text (BT_ERR_INPUT).
BT_PUBLIC BT_CHECKED bt_status bt_case_open_text(const char* name, const char* text, size_t size,
                                                 bt_message* message, void* user, bt_case** opened);

/// The same without a file: every key at its default (`bolter keys --defaults`), to be changed by
/// bt_case_set and bt_case_set_text.
BT_PUBLIC BT_CHECKED bt_status bt_case_open_defaults(const char* name, bt_message* message,
                                                     void* user, bt_case** opened);

/// As bt_case_open for a file that may describe no more than rigs and the parts that they test.
/// With such a case only bt_case_rig (rig.h) works.
BT_PUBLIC BT_CHECKED bt_status bt_case_open_rigs(const char* path, const char* const* sets,
                                                 int set_count, bt_message* message, void* user,
                                                 bt_case** opened);

/// Releases a case; accepts NULL.
BT_PUBLIC void bt_case_close(bt_case* opened);

/// Sets a numeric key of the model ("aircraft.hook.profile.lip_height"), SI. Fast: for loops over
/// many landings.
/// BT_ERR_ARG: no such key, not a number, or a value outside its range; the reason goes to the
/// message function and nothing is changed.
BT_PUBLIC BT_CHECKED bt_status bt_case_set(bt_case* opened, const char* path, double value);
BT_PUBLIC BT_CHECKED bt_status bt_case_get(const bt_case* opened, const char* path, double* value);

/// Sets any key of the study to a text as --set takes it: numbers with their unit, choices, lists,
/// tables, distributions ("uncertainty.landing.pitch", "{distribution: normal, mean: 3 deg, sd: 1
/// deg}"). The study is read anew with it: BT_ERR_INPUT, BT_ERR_IO and BT_ERR_MEMORY as
/// bt_case_open; on an error nothing is changed.
BT_PUBLIC BT_CHECKED bt_status bt_case_set_text(bt_case* opened, const char* path,
                                                const char* value);

/// The study's title; its directory; valid until the case is changed or closed.
BT_PUBLIC const char* bt_case_title(const bt_case* opened);
BT_PUBLIC const char* bt_case_directory(const bt_case* opened);

/// Puts the study directory (ledger, classifier, results) elsewhere; it is made when it is needed.
/// BT_ERR_ARG: the path is too long.
BT_PUBLIC BT_CHECKED bt_status bt_case_set_directory(bt_case* opened, const char* path);

/// The whole study as one YAML text with every key: aircraft and deck included, changes by
/// bt_case_set_text applied. Valid as above.
BT_PUBLIC const char* bt_case_text(const bt_case* opened);

/// One key of the model.
typedef struct bt_key {
    const char* path;     ///< "landing.sink_speed"
    const char* unit;     ///< SI, as written: "m/s"; "" for ratios, counts, choices
    const char* kind;     ///< "number", "count", "flag", "choice", "list", "table"
    const char* equation; ///< "Eq. 3"; "" where the paper has none
    const char*
        text; ///< meaning; ends in [assumed] or [calibrated] where the default has no source
    double fallback, least, greatest; ///< default and range, SI; numbers and counts only
} bt_key;

/// Calls visit for every key of the model, in the order of `bolter keys`, until it returns false.
/// The key is valid during the call only.
typedef bool bt_key_visit(void* user, const bt_key* key);
BT_PUBLIC void bt_keys(bt_key_visit* visit, void* user);

#ifdef __cplusplus
}
#endif

#endif

/// The typed reader: field tables on one side, a tree of texts on the other.
#ifndef BT_STUDY_READER_H
#define BT_STUDY_READER_H

#include "base/fields.h"
#include "study/document.h"

enum { BT_MESSAGES_SHOWN_MAX = 20, BT_MESSAGE_SIZE = 1024 };

typedef struct bt_reader_message {
    bt_severity severity;
    bt_where where;
    char text[BT_MESSAGE_SIZE];
} bt_reader_message;

/// Collects messages, to hand them on in the order of the files.
typedef struct bt_reader {
    int errors;  ///< all of them; at most BT_MESSAGES_SHOWN_MAX messages are kept
    int dropped; ///< messages beyond that
    int message_count;
    bt_reader_message messages[BT_MESSAGES_SHOWN_MAX];
} bt_reader;

/// Adds an error at a place; text begins with the path it is about. Control characters that came
/// from the file become '?'.
void bt_reader_error(bt_reader* reader, bt_where where, const char* format, ...)
    __attribute__((format(printf, 3, 4)));

/// A diag whose messages the reader collects.
bt_diag bt_reader_diag(bt_reader* reader);

/// Hands the messages on: by file in order of first mention, then by line and column. Errors that
/// were dropped are counted in diag and mentioned.
void bt_reader_flush(bt_reader* reader, bt_diag* diag);

/// Reads a mapping into a struct whose defaults are set: every key known, none twice, none missing
/// that is required, every value of the right kind and dimension, finite and inside its range;
/// then the groups' own checks wherever a group had no error.
/// @param node   the mapping; keys in `also` are left to the caller
/// @param also   NULL-terminated names of further keys, or NULL
void bt_reader_group(bt_reader* reader, const bt_group* group, void* params, const char* path,
                     const bt_node* node, const char* const* also);

/// Reads one number with the unit, kind and range of a field. False after reporting an error.
/// `ranged` false: only the dimension matters (a standard deviation).
bool bt_reader_number(bt_reader* reader, const bt_field* field, const bt_node* node,
                      const char* path, bool ranged, double* value);

/// Reads one of the names; false after reporting an error.
bool bt_reader_choice(bt_reader* reader, const char* const* names, const bt_node* node,
                      const char* path, int* value);

/// True for a mapping; otherwise reports what was wanted. Also reports keys given twice.
bool bt_reader_is_mapping(bt_reader* reader, const bt_node* node, const char* path);

/// Reports the keys of a mapping that are in neither list (`more` may be NULL).
void bt_reader_known_keys(bt_reader* reader, const bt_node* node, const char* path,
                          const char* const* names, const char* const* more);

/// Runs bt_group_check on the whole and reports its errors at the places they are about.
void bt_reader_check(bt_reader* reader, const bt_group* group, const void* params, const char* path,
                     const bt_node* node);

/// path + "." + name; either may be empty.
void bt_reader_join(char* joined, size_t size, const char* path, const char* name);

#endif

/// Other files that a study names.
#ifndef BT_STUDY_FILES_H
#define BT_STUDY_FILES_H

#include "study/reader.h"
#include "study/study.h"

typedef struct bt_study_files {
    bt_document* names;     ///< owns their names, as long as the study lives
    const char* study_path; ///< NULL: no files may be named
} bt_study_files;

/// The path of the file that a value names, relative to the file that the value stands in; NULL
/// after reporting why there is none.
const char* bt_study_file(bt_reader* reader, const bt_study_files* files, const bt_node* node,
                          const char* key);

/// Remembers that a study was read from a file (bt_study_reads).
void bt_study_note_file(bt_study* study, const char* path);

#endif

/// HDF5 files: whole ones, and texts in them.
#ifndef BT_REPORT_HDF5_TEXT_H
#define BT_REPORT_HDF5_TEXT_H

#include "base/diag.h"

#include <hdf5.h>
#include <stdbool.h>

/// A text as an attribute of an object. False when HDF5 refuses.
bool bt_hdf5_attribute(hid_t object, const char* name, const char* text);

/// A text as a dataset of one string: it may be longer than an attribute can be.
bool bt_hdf5_text(hid_t file, const char* name, const char* text);

/// Whether nothing of a user's is lost when a file is replaced: there is none, it is empty, or it
/// holds histories that Bolter wrote.
bool bt_hdf5_may_go(const char* path);

/// Puts the content into an open file. False when HDF5 refuses.
typedef bool bt_hdf5_content(hid_t file, const void* user);

/// Writes a file under a temporary name, then renames it: a reader sees the old file or the new
/// one. Replaces nothing of a user's. BT_ERR_IO, said in diag.
BT_CHECKED bt_status bt_hdf5_write(const char* path, bt_hdf5_content* content, const void* user,
                                   bt_diag* diag);

#endif

/// Texts in HDF5 files.
#ifndef BT_REPORT_HDF5_TEXT_H
#define BT_REPORT_HDF5_TEXT_H

#include <hdf5.h>
#include <stdbool.h>

/// A text as an attribute of an object. False when HDF5 refuses.
bool bt_hdf5_attribute(hid_t object, const char* name, const char* text);

/// A text as a dataset of one string: it may be longer than an attribute can be.
bool bt_hdf5_text(hid_t file, const char* name, const char* text);

/// Whether nothing of a user's is lost when a file is replaced: there is none, it is empty, or it
/// holds histories that Bolter wrote.
bool bt_hdf5_may_go(const char* path);

#endif

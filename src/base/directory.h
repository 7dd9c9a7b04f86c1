/// The study directory: where everything a study produces is kept. One process at a time writes
/// in it; every file appears under its name only when it is complete.
#ifndef BT_BASE_DIRECTORY_H
#define BT_BASE_DIRECTORY_H

#include "base/diag.h"

#include <stdbool.h>
#include <stddef.h>

enum { BT_FILE_PATH_MAX = 4352 };

/// The right to write in a study directory.
typedef struct bt_directory {
    const char* path; ///< the caller's
    int lock;         ///< descriptor; -1 when not held
} bt_directory;

/// Makes a directory and those above it, as mkdir -p. BT_ERR_IO, said in diag.
BT_CHECKED bt_status bt_directory_make(const char* path, bt_diag* diag);

/// Makes the directory (and those above it) and takes its lock. The lock goes with the process,
/// however it ends. BT_ERR_IO, said in diag: cannot be made or written, or another process
/// (named) works in it. `path` must outlive the directory.
BT_CHECKED bt_status bt_directory_open(bt_directory* directory, const char* path, bt_diag* diag);

/// Gives the lock back; accepts one that was never opened if its lock is -1.
void bt_directory_close(bt_directory* directory);

/// "PATH/NAME" into a buffer of BT_FILE_PATH_MAX bytes. BT_ERR_ARG when it does not fit.
BT_CHECKED bt_status bt_file_path(char* buffer, const char* directory, const char* name);

/// The name beside `path` under which a file is written until it is complete, into a buffer of
/// BT_FILE_PATH_MAX bytes; another for every process. BT_ERR_IO, said in diag, when it is too long.
BT_CHECKED bt_status bt_file_temporary(const char* path, char* temporary, bt_diag* diag);

/// Ends what bt_file_temporary began: a file that was written well gets its name, any other goes.
///
/// @param good  whether it was written and closed
/// @param code  errno of what went wrong; 0: not known
/// @return BT_OK, or BT_ERR_IO, said in diag
BT_CHECKED bt_status bt_file_finish(const char* path, const char* temporary, bool good, int code,
                                    bt_diag* diag);

/// Writes a whole file under a temporary name beside it, forces it to disk and renames it: a
/// reader sees the old file or the new one, never a part. BT_ERR_IO, said in diag; what was there
/// before stays.
BT_CHECKED bt_status bt_file_write(const char* path, const char* data, size_t size, bt_diag* diag);

/// As bt_file_write, for a place where a user may have a file of their own: what is there is
/// replaced only when it is empty or its first `mark_length` bytes are those of `data`, the mark of
/// what Bolter writes. BT_ERR_IO, said in diag, when it is not.
BT_CHECKED bt_status bt_file_replace(const char* path, const char* data, size_t size,
                                     size_t mark_length, bt_diag* diag);

/// Says that a file was not written by Bolter and stays; returns BT_ERR_IO.
bt_status bt_file_refuse(const char* path, bt_diag* diag);

/// Reads a whole file into memory that the caller frees; a zero byte follows the data. size may be
/// NULL. BT_ERR_IO, said in diag (also from 1 GiB on); BT_ERR_MEMORY.
BT_CHECKED bt_status bt_file_read(const char* path, char** data, size_t* size, bt_diag* diag);

#endif

/// A capsule: a campaign with everything that belongs to it, in one file to send and to keep. It is
/// a copy of the ledger, open to SQL like any, that carries files in a table `sqlar`: an SQLite
/// archive (sqlite.org/sqlar.html), which `sqlite3 FILE -Ax` unpacks.
#ifndef BT_CAMPAIGN_CAPSULE_H
#define BT_CAMPAIGN_CAPSULE_H

#include "campaign/ledger.h"

/// A file of a capsule.
typedef struct bt_capsule_file {
    char* name; ///< "study.yaml", "figures/fig19.pdf"
    char* data;
    size_t size; ///< bytes; below 1 GB, SQLite's limit
} bt_capsule_file;

/// Writes ledger and files under a temporary name and renames it. What was there is replaced only
/// when it is a capsule. BT_ERR_IO, said in diag; BT_ERR_MEMORY.
BT_CHECKED bt_status bt_capsule_write(bt_ledger* ledger, const char* path,
                                      const bt_capsule_file* files, int count, bt_diag* diag);

/// Reads one of its files into memory that the caller frees; a zero byte follows the data. `size`
/// may be NULL. BT_ERR_IO, said in diag: no capsule, a damaged one, none of that name.
BT_CHECKED bt_status bt_capsule_read(const char* path, const char* name, char** data, size_t* size,
                                     bt_diag* diag);

#endif

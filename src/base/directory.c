#include "base/directory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FILE_SIZE_MAX = 1 << 30 }; // a device may never end

static bt_status fail(bt_diag* diag, const char* path, const char* what, int code) {
    bt_diag_add(diag, BT_ERROR, (bt_where){.file = path}, "%s: %s", what,
                code ? strerror(code) : "the system gives no reason");
    return BT_ERR_IO;
}

bt_status bt_file_path(char* buffer, const char* directory, const char* name) {
    const int length = snprintf(buffer, BT_FILE_PATH_MAX, "%s/%s", directory, name);
    return length < 0 || length >= BT_FILE_PATH_MAX ? BT_ERR_ARG : BT_OK;
}

bt_status bt_directory_make(const char* path, bt_diag* diag) {
    char part[BT_FILE_PATH_MAX];
    if (strlen(path) >= sizeof part)
        return fail(diag, path, "cannot make the study directory", ENAMETOOLONG);
    for (size_t i = 1;; ++i) {
        if (path[i] != '/' && path[i] != '\0')
            continue;
        memcpy(part, path, i);
        part[i] = '\0';
        struct stat info;
        if (mkdir(part, 0777) != 0 && errno != EEXIST)
            return fail(diag, part, "cannot make the study directory", errno);
        if (stat(part, &info) != 0 || !S_ISDIR(info.st_mode))
            return fail(diag, part, "cannot make the study directory", ENOTDIR);
        if (path[i] == '\0')
            return BT_OK;
    }
}

/// Says who holds the lock, as far as the lock file tells.
static bt_status say_busy(const bt_directory* directory, bt_diag* diag) {
    char owner[32] = "";
    const ssize_t got = pread(directory->lock, owner, sizeof owner - 1, 0);
    owner[got > 0 ? got : 0] = '\0';
    owner[strcspn(owner, "\n")] = '\0';
    bt_diag_add(diag, BT_ERROR, (bt_where){.file = directory->path},
                "another bolter (process %s) is working in this study directory; wait for it, or "
                "use another directory with -o",
                owner[0] ? owner : "unknown");
    return BT_ERR_IO;
}

bt_status bt_directory_open(bt_directory* directory, const char* path, bt_diag* diag) {
    *directory = (bt_directory){.path = path, .lock = -1};
    char name[BT_FILE_PATH_MAX];
    BT_TRY(bt_directory_make(path, diag));
    BT_TRY(bt_file_path(name, path, "lock"));
    directory->lock = open(name, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (directory->lock < 0)
        return fail(diag, name, "the study directory cannot be written", errno);

    bt_status status = BT_OK;
    if (flock(directory->lock, LOCK_EX | LOCK_NB) != 0)
        status = errno == EWOULDBLOCK ? say_busy(directory, diag)
                                      : fail(diag, name, "cannot lock the study directory", errno);
    else if (ftruncate(directory->lock, 0) != 0 ||
             dprintf(directory->lock, "%ld\n", (long)getpid()) < 0)
        status = fail(diag, name, "the study directory cannot be written", errno);
    if (status != BT_OK)
        bt_directory_close(directory);
    return status;
}

void bt_directory_close(bt_directory* directory) {
    if (directory->lock >= 0)
        close(directory->lock);
    directory->lock = -1;
}

static bool write_all(int file, const char* data, size_t size) {
    while (size > 0) {
        const ssize_t put = write(file, data, size);
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return false;
        data += put;
        size -= (size_t)put;
    }
    return true;
}

bt_status bt_file_temporary(const char* path, char* temporary, bt_diag* diag) {
    const int length = snprintf(temporary, BT_FILE_PATH_MAX, "%s.%ld.new", path, (long)getpid());
    if (length < 0 || length >= BT_FILE_PATH_MAX)
        return fail(diag, path, "cannot write", ENAMETOOLONG);
    return BT_OK;
}

bt_status bt_file_finish(const char* path, const char* temporary, bool good, int code,
                         bt_diag* diag) {
    if (good && rename(temporary, path) == 0)
        return BT_OK;
    if (good)
        code = errno;
    unlink(temporary);
    return fail(diag, path, "cannot write", code);
}

bt_status bt_file_write(const char* path, const char* data, size_t size, bt_diag* diag) {
    char temporary[BT_FILE_PATH_MAX];
    BT_TRY(bt_file_temporary(path, temporary, diag));
    const int file = open(temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        return fail(diag, path, "cannot write", errno);
    bool good = write_all(file, data, size) && fsync(file) == 0;
    int code = errno;
    if (close(file) != 0 && good) {
        good = false;
        code = errno;
    }
    return bt_file_finish(path, temporary, good, code, diag);
}

bt_status bt_file_refuse(const char* path, bt_diag* diag) {
    bt_diag_add(diag, BT_ERROR, (bt_where){.file = path},
                "not written by Bolter, so it is not replaced; move it away, or use another name "
                "with -o");
    return BT_ERR_IO;
}

/// Whether nothing is lost when a file goes: there is none, it is empty, or it has the mark.
static bool may_go(const char* path, const char* mark, size_t length) {
    char there[256];
    struct stat info;
    if (stat(path, &info) != 0 || info.st_size == 0)
        return true;
    FILE* file = S_ISREG(info.st_mode) && length <= sizeof there ? fopen(path, "rb") : NULL;
    if (!file)
        return false;
    const bool same = fread(there, 1, length, file) == length && memcmp(there, mark, length) == 0;
    fclose(file);
    return same;
}

bt_status bt_file_replace(const char* path, const char* data, size_t size, size_t mark_length,
                          bt_diag* diag) {
    if (!may_go(path, data, mark_length))
        return bt_file_refuse(path, diag);
    return bt_file_write(path, data, size, diag);
}

static bt_status read_open(const char* path, FILE* file, char** data, size_t* size, bt_diag* diag) {
    size_t room = 65536, used = 0;
    char* text = malloc(room);
    while (text) {
        used += fread(text + used, 1, room - used - 1, file);
        if (used < room - 1)
            break;
        if (room >= FILE_SIZE_MAX) {
            free(text);
            return fail(diag, path, "cannot read", EFBIG);
        }
        char* larger = realloc(text, room *= 2);
        if (!larger)
            free(text);
        text = larger;
    }
    if (!text)
        return BT_ERR_MEMORY;
    if (ferror(file)) {
        free(text);
        return fail(diag, path, "cannot read", errno);
    }
    text[used] = '\0';
    *data = text;
    if (size)
        *size = used;
    return BT_OK;
}

bt_status bt_file_read(const char* path, char** data, size_t* size, bt_diag* diag) {
    FILE* file = fopen(path, "rb");
    if (!file)
        return fail(diag, path, "cannot read", errno);
    const bt_status status = read_open(path, file, data, size, diag);
    fclose(file);
    return status;
}

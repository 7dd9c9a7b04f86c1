#include "report/hdf5_text.h"

#include "base/directory.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

bool bt_hdf5_attribute(hid_t object, const char* name, const char* text) {
    const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
    bool good = space >= 0 && type >= 0 && H5Tset_size(type, strlen(text) + 1) >= 0 &&
                H5Tset_cset(type, H5T_CSET_UTF8) >= 0;
    const hid_t attribute =
        good ? H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT) : -1;
    good = attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    if (attribute >= 0)
        good &= H5Aclose(attribute) >= 0;
    if (type >= 0)
        H5Tclose(type);
    if (space >= 0)
        H5Sclose(space);
    return good;
}

bool bt_hdf5_text(hid_t file, const char* name, const char* text) {
    const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
    bool good = space >= 0 && type >= 0 && H5Tset_size(type, strlen(text) + 1) >= 0 &&
                H5Tset_cset(type, H5T_CSET_UTF8) >= 0;
    const hid_t set =
        good ? H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT) : -1;
    good = set >= 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) >= 0;
    if (set >= 0)
        good &= H5Dclose(set) >= 0;
    if (type >= 0)
        H5Tclose(type);
    if (space >= 0)
        H5Sclose(space);
    return good;
}

bool bt_hdf5_may_go(const char* path) {
    struct stat info;
    if (stat(path, &info) != 0 || info.st_size == 0)
        return true;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // another kind of file is no error here
    const hid_t file = S_ISREG(info.st_mode) ? H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT) : -1;
    if (file < 0)
        return false;
    const bool ours = H5Aexists(file, "title") > 0 && H5Lexists(file, "study", H5P_DEFAULT) > 0;
    H5Fclose(file);
    return ours;
}

bt_status bt_hdf5_write(const char* path, bt_hdf5_content* content, const void* user,
                        bt_diag* diag) {
    char temporary[BT_FILE_PATH_MAX];
    if (!bt_hdf5_may_go(path))
        return bt_file_refuse(path, diag);
    BT_TRY(bt_file_temporary(path, temporary, diag));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // errors are ours to report
    errno = 0;
    const hid_t file = H5Fcreate(temporary, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    bool good = file >= 0 && content(file, user);
    if (file >= 0)
        good &= H5Fclose(file) >= 0;
    return bt_file_finish(path, temporary, good, errno, diag);
}

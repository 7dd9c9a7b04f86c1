#include "report/rig_record.h"

#include "base/directory.h"
#include "base/units.h"
#include "report/hdf5_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The written unit of a name with a unit token at its end: "m/s" of "stroke_rate_mps".
static const char* unit_of(const char* name) {
    const char* last = strrchr(name, '_');
    const char* unit = last ? bt_unit_text(last + 1) : NULL;
    return unit ? unit : "1";
}

static bool write_column(const bt_rig_record* record, hid_t file, int column) {
    const hsize_t count = (hsize_t)record->count;
    const hid_t space = H5Screate_simple(1, &count, NULL);
    const hid_t set = space < 0 ? -1
                                : H5Dcreate2(file, record->names[column], H5T_IEEE_F64LE, space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    bool good = set >= 0 &&
                H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         record->columns[column]) >= 0 &&
                bt_hdf5_attribute(set, "unit", unit_of(record->names[column]));
    if (set >= 0)
        good &= H5Dclose(set) >= 0;
    if (space >= 0)
        H5Sclose(space);
    return good;
}

static bool write_number(hid_t file, const char* name, double value) {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        space < 0 ? -1 : H5Acreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    bool good = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
    if (attribute >= 0)
        good &= H5Aclose(attribute) >= 0;
    if (space >= 0)
        H5Sclose(space);
    return good;
}

/// What goes into a file.
typedef struct content {
    const bt_rig_record* record;
    const bt_study* study;
    const bt_rig_result* result;
} content;

static bool write_all(hid_t file, const void* user) {
    const content* c = user;
    const bt_rig_record* record = c->record;
    const bt_rig_result* result = c->result;
    bool good = bt_hdf5_attribute(file, "title", c->study->title) &&
                bt_hdf5_attribute(file, "rig", bt_rig_keys[record->kind]) &&
                bt_hdf5_text(file, "study", c->study->text);
    for (int i = 0; good && i < record->column_count; ++i)
        good = write_column(record, file, i);
    for (int i = 0; good && i < result->metric_count; ++i) {
        const bt_metric* m = &result->metrics[i];
        char name[96];
        snprintf(name, sizeof name, "%s_reference", m->name);
        good = write_number(file, m->name, m->value);
        if (good && isfinite(m->reference))
            good = write_number(file, name, m->reference);
    }
    return good;
}

bt_status bt_rig_record_write(const bt_rig_record* record, const char* path, const bt_study* study,
                              const bt_rig_result* result, bt_diag* diag) {
    if (record->out_of_memory)
        return BT_ERR_MEMORY;
    if (bt_study_reads(study, path))
        return bt_file_refuse(path, diag);
    return bt_hdf5_write(path, write_all, &(content){record, study, result}, diag);
}

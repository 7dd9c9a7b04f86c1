#include "base/fields.h"

#include "base/text.h"
#include "base/units.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 256 };

static void join(char* path, const char* parent, const char* name) {
    snprintf(path, PATH_SIZE, "%s%s%s", parent, *parent ? "." : "", name);
}

static void set_default(const bt_field* field, void* member) {
    switch (field->kind) {
    case BT_FIELD_REAL:
    case BT_FIELD_PLAIN:
        *(double*)member = field->fallback;
        break;
    case BT_FIELD_COUNT:
        *(int64_t*)member = (int64_t)field->fallback;
        break;
    case BT_FIELD_FLAG:
        *(bool*)member = field->fallback != 0;
        break;
    case BT_FIELD_CHOICE:
        *(int*)member = (int)field->fallback;
        break;
    case BT_FIELD_LIST:
        *(bt_list*)member = (bt_list){0};
        break;
    case BT_FIELD_TABLE:
        *(bt_table*)member = (bt_table){0};
        break;
    case BT_FIELD_GROUP:
        bt_group_set_defaults(field->group, member);
        break;
    }
}

void bt_group_set_defaults(const bt_group* group, void* params) {
    memset(params, 0, group->size);
    for (int i = 0; i < group->field_count; ++i)
        set_default(&group->fields[i], (char*)params + group->fields[i].offset);
}

static void report_range(const bt_field* field, double value, const char* path, bt_diag* diag) {
    char number[64], least[64], greatest[64];
    bt_text_print_number(value, number, sizeof number);
    bt_text_print_number(field->least, least, sizeof least);
    bt_unit_print(field->greatest, field->unit, greatest, sizeof greatest);
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: %s is outside %s .. %s", path, number, least,
                greatest);
}

static bool check_number(const bt_field* field, double value, const char* path, bt_diag* diag) {
    if (value >= field->least && value <= field->greatest) // a NaN fails
        return true;
    report_range(field, value, path, diag);
    return false;
}

static bool check_list(const bt_field* field, const bt_list* list, const char* path,
                       bt_diag* diag) {
    if (!(field->least < field->greatest))
        return true;
    bool good = true;
    for (int i = 0; i < list->count; ++i)
        good &= check_number(field, list->value[i], path, diag);
    return good;
}

static bool check_choice(const bt_field* field, int value, const char* path, bt_diag* diag) {
    int count = 0;
    while (field->choices[count])
        ++count;
    if (value >= 0 && value < count)
        return true;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "%s: choice %d is outside 0 .. %d", path, value,
                count - 1);
    return false;
}

static bool check_member(const bt_field* field, const void* member, const char* path,
                         bt_diag* diag) {
    switch (field->kind) {
    case BT_FIELD_REAL:
    case BT_FIELD_PLAIN:
    case BT_FIELD_COUNT:
        return check_number(field, bt_field_get(field, member, 0), path, diag);
    case BT_FIELD_CHOICE:
        return check_choice(field, *(const int*)member, path, diag);
    case BT_FIELD_LIST:
        return check_list(field, member, path, diag);
    case BT_FIELD_GROUP:
        return bt_group_check(field->group, member, path, diag) == BT_OK;
    case BT_FIELD_FLAG:
    case BT_FIELD_TABLE:
        break;
    }
    return true;
}

bt_status bt_group_check(const bt_group* group, const void* params, const char* path,
                         bt_diag* diag) {
    bool good = true;
    for (int i = 0; i < group->field_count; ++i) {
        char member_path[PATH_SIZE];
        join(member_path, path, group->fields[i].name);
        good &= check_member(&group->fields[i], (const char*)params + group->fields[i].offset,
                             member_path, diag);
    }
    if (good && group->check) { // it may rely on the ranges
        bt_diag own = diag ? *diag : (bt_diag){0};
        own.errors = 0;
        group->check(params, path, &own);
        good = own.errors == 0;
        if (diag) {
            diag->errors += own.errors;
            diag->warnings = own.warnings;
        }
    }
    return good ? BT_OK : BT_ERR_INPUT;
}

static const bt_field* find_named(const bt_group* group, const char* name, size_t length) {
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        if (strlen(field->name) == length && memcmp(field->name, name, length) == 0)
            return field;
    }
    return NULL;
}

const bt_field* bt_group_find(const bt_group* group, const char* path, size_t* offset) {
    size_t at = 0;
    while (group) {
        const size_t length = strcspn(path, ".");
        const bt_field* field = find_named(group, path, length);
        if (!field)
            return NULL;
        at += field->offset;
        if (path[length] == '\0') {
            if (offset)
                *offset = at;
            return field;
        }
        group = field->group;
        path += length + 1;
    }
    return NULL;
}

static bool walk(const bt_group* group, const char* path, size_t offset, bt_field_visit* visit,
                 void* user) {
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        char member_path[PATH_SIZE];
        join(member_path, path, field->name);
        const size_t at = offset + field->offset;
        const bool go_on = field->kind == BT_FIELD_GROUP
                               ? walk(field->group, member_path, at, visit, user)
                               : visit(user, field, member_path, at);
        if (!go_on)
            return false;
    }
    return true;
}

void bt_group_walk(const bt_group* group, bt_field_visit* visit, void* user) {
    walk(group, "", 0, visit, user);
}

double bt_field_get(const bt_field* field, const void* params, size_t offset) {
    const void* member = (const char*)params + offset;
    if (field->kind == BT_FIELD_COUNT)
        return (double)*(const int64_t*)member;
    return *(const double*)member;
}

void bt_field_set(const bt_field* field, void* params, size_t offset, double value) {
    void* member = (char*)params + offset;
    if (field->kind == BT_FIELD_COUNT)
        *(int64_t*)member = (int64_t)value;
    else
        *(double*)member = value;
}

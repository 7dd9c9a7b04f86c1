#include "base/fields.h"

#include "base/text.h"
#include "base/units.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 256 };

static void join(char* path, const char* parent, const char* name) {
    snprintf(path, PATH_SIZE, "%s%s%s", parent, *parent ? "." : "", name);
}

const bt_group* bt_variant_group(const bt_variant* variant, const bt_variant_head* member) {
    return variant->groups[member->type];
}

void bt_variant_set(const bt_variant* variant, int type, bt_variant_head* member) {
    member->type = type;
    memset(member->params, 0, variant->size);
    bt_group_set_defaults(variant->groups[type], member->params);
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
    case BT_FIELD_VARIANT:
        bt_variant_set(field->variant, 0, member);
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

static bool check_variant(const bt_variant* variant, const bt_variant_head* member,
                          const char* path, bt_diag* diag) {
    char type_path[PATH_SIZE];
    join(type_path, path, variant->type.name);
    return check_choice(&variant->type, member->type, type_path, diag) &&
           bt_group_check(bt_variant_group(variant, member), member->params, path, diag) == BT_OK;
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
    case BT_FIELD_VARIANT:
        return check_variant(field->variant, member, path, diag);
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

/// The table below a field that has one, and where its struct begins; NULL for a leaf. `params` is
/// the outermost struct or NULL, *offset the place of the member in it.
static const bt_group* below(const bt_field* field, const void* params, size_t* offset) {
    if (field->kind == BT_FIELD_GROUP)
        return field->group;
    if (field->kind != BT_FIELD_VARIANT)
        return NULL;
    const bt_variant_head* member = params ? (const void*)((const char*)params + *offset) : NULL;
    *offset += offsetof(bt_variant_head, params);
    return member ? bt_variant_group(field->variant, member) : field->variant->groups[0];
}

const bt_field* bt_params_find(const bt_group* group, const void* params, const char* path,
                               size_t* offset) {
    size_t at = 0;
    while (group) {
        const size_t length = strcspn(path, ".");
        const bt_field* field = find_named(group, path, length);
        if (!field)
            return NULL;
        at += field->offset;
        if (path[length] != '\0' && field->kind == BT_FIELD_VARIANT &&
            strcmp(path + length + 1, field->variant->type.name) == 0) {
            field = &field->variant->type;
            path += length + 1 + strlen(field->name);
        } else {
            path += length;
        }
        if (*path == '\0') {
            if (offset)
                *offset = at;
            return field;
        }
        group = below(field, params, &at);
        ++path;
    }
    return NULL;
}

const bt_field* bt_group_find(const bt_group* group, const char* path, size_t* offset) {
    return bt_params_find(group, NULL, path, offset);
}

typedef struct walker {
    const void* params;
    bt_field_visit* visit;
    void* user;
} walker;

static bool walk(const walker* w, const bt_group* group, const char* path, size_t offset) {
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        char member_path[PATH_SIZE], type_path[PATH_SIZE];
        join(member_path, path, field->name);
        size_t at = offset + field->offset;
        if (field->kind == BT_FIELD_VARIANT) {
            join(type_path, member_path, field->variant->type.name);
            if (!w->visit(w->user, &field->variant->type, type_path, at))
                return false;
        }
        const bt_group* inner = below(field, w->params, &at);
        if (!(inner ? walk(w, inner, member_path, at) : w->visit(w->user, field, member_path, at)))
            return false;
    }
    return true;
}

void bt_params_walk(const bt_group* group, const void* params, bt_field_visit* visit, void* user) {
    walk(&(walker){params, visit, user}, group, "", 0);
}

void bt_group_walk(const bt_group* group, bt_field_visit* visit, void* user) {
    bt_params_walk(group, NULL, visit, user);
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

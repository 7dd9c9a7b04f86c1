#include "mechanics/system.h"

#include "mechanics/dynamics.h"
#include "mechanics/vec.h"

#include <stdlib.h>
#include <string.h>

bt_status bt_system_create(bt_system** system) {
    *system = calloc(1, sizeof **system);
    if (!*system)
        return BT_ERR_MEMORY;
    return BT_OK;
}

void bt_system_destroy(bt_system* system) {
    if (!system)
        return;
    for (int i = 0; i < system->body_count; ++i)
        free(system->bodies[i].name);
    for (int i = 0; i < system->joint_count; ++i)
        free(system->joints[i].name);
    for (int i = 0; i < system->element_count; ++i) {
        free((void*)system->elements[i].element.name);
        free((void*)system->elements[i].element.data);
    }
    free(system->bodies);
    free(system->joints);
    free(system->elements);
    bt_kkt_destroy(&system->kkt);
    free(system);
}

/// Makes room for one more; false when memory ran out, which is remembered.
static bool grow(bt_system* system, void** items, int count, int* capacity, size_t size) {
    if (count < *capacity)
        return true;
    const int wanted = *capacity ? 2 * *capacity : 16;
    void* grown = realloc(*items, size * (size_t)wanted);
    if (!grown) {
        system->add_status = BT_ERR_MEMORY;
        return false;
    }
    *items = grown;
    *capacity = wanted;
    return true;
}

static char* copy_text(bt_system* system, const char* text) {
    const size_t size = strlen(text ? text : "") + 1;
    char* copy = malloc(size);
    if (copy)
        memcpy(copy, text ? text : "", size);
    else
        system->add_status = BT_ERR_MEMORY;
    return copy;
}

int bt_system_add_body(bt_system* system, const bt_body_def* def) {
    if (!grow(system, (void**)&system->bodies, system->body_count, &system->body_capacity,
              sizeof *system->bodies))
        return -1;
    bt_body body = {.mass_kg = def->mass_kg};
    body.name = copy_text(system, def->name);
    if (!body.name)
        return -1;
    memcpy(body.given_inertia, def->inertia_kgm2, sizeof body.given_inertia);
    memcpy(body.q, def->position_m, 3 * sizeof(double));
    memcpy(body.q + 3, def->attitude, 4 * sizeof(double));
    memcpy(body.v, def->velocity_mps, 3 * sizeof(double));
    memcpy(body.v + 3, def->spin_radps, 3 * sizeof(double));
    system->assembled = false;
    system->bodies[system->body_count] = body;
    return system->body_count++;
}

int bt_system_add_joint(bt_system* system, const bt_joint_def* def) {
    if (!grow(system, (void**)&system->joints, system->joint_count, &system->joint_capacity,
              sizeof *system->joints))
        return -1;
    bt_joint joint = {
        .kind = def->kind, .body_a = def->body_a, .body_b = def->body_b, .length_m = def->length_m};
    joint.name = copy_text(system, def->name);
    if (!joint.name)
        return -1;
    memcpy(joint.point_a, def->point_a_m, sizeof joint.point_a);
    memcpy(joint.point_b, def->point_b_m, sizeof joint.point_b);
    memcpy(joint.axis_a, def->axis_a, sizeof joint.axis_a);
    memcpy(joint.axis_b, def->axis_b, sizeof joint.axis_b);
    memcpy(joint.attitude_ab, def->attitude_ab, sizeof joint.attitude_ab);
    system->assembled = false;
    system->joints[system->joint_count] = joint;
    return system->joint_count++;
}

int bt_system_add_element(bt_system* system, const bt_element* def) {
    if (!grow(system, (void**)&system->elements, system->element_count, &system->element_capacity,
              sizeof *system->elements))
        return -1;
    bt_element copy = *def;
    char* name = copy_text(system, def->name);
    void* data = malloc(def->type->data_size ? def->type->data_size : 1);
    if (!name || !data) {
        system->add_status = BT_ERR_MEMORY;
        free(name);
        free(data);
        return -1;
    }
    if (def->type->data_size)
        memcpy(data, def->data, def->type->data_size);
    copy.name = name;
    copy.data = data;
    system->elements[system->element_count] = (bt_element_slot){copy, system->output_count};
    system->output_count += def->type->output_count;
    system->assembled = false;
    return system->element_count++;
}

void bt_system_set_gravity(bt_system* system, const double gravity_mps2[3]) {
    memcpy(system->gravity_mps2, gravity_mps2, sizeof system->gravity_mps2);
}

int bt_system_constraint_count(const bt_system* system) {
    return system->constraint_count;
}

int bt_system_redundant_count(const bt_system* system) {
    return system->redundant_count;
}

int bt_system_body_find(const bt_system* system, const char* name) {
    for (int i = 0; i < system->body_count; ++i)
        if (strcmp(system->bodies[i].name, name) == 0)
            return i;
    return -1;
}

int bt_system_joint_find(const bt_system* system, const char* name) {
    for (int i = 0; i < system->joint_count; ++i)
        if (strcmp(system->joints[i].name, name) == 0)
            return i;
    return -1;
}

int bt_system_element_find(const bt_system* system, const char* name) {
    for (int i = 0; i < system->element_count; ++i)
        if (strcmp(system->elements[i].element.name, name) == 0)
            return i;
    return -1;
}

const double* bt_system_element_output(const bt_system* system, const bt_state* state,
                                       int element) {
    return state->output + system->elements[element].output_first;
}

bt_law bt_system_element_law(const bt_system* system, const bt_state* state, int element,
                             const char** what) {
    const bt_element* e = &system->elements[element].element;
    if (!e->type->law)
        return BT_LAW_HOLDS;
    return e->type->law(e, bt_system_element_output(system, state, element), what);
}

const char* bt_system_element_name(const bt_system* system, int element) {
    return system->elements[element].element.name;
}

int bt_system_element_count(const bt_system* system) {
    return system->element_count;
}

/* ------------------------------------------------------------------ a state's one block */

/// Pieces of the block in order; called with block NULL to measure. Returns its size in bytes.
static size_t lay_out(const bt_system* system, unsigned char* block, bt_state* state,
                      bt_work* work) {
    const size_t n = (size_t)system->body_count, m = (size_t)system->constraint_count;
    const size_t refine = system->refinements ? (size_t)system->kkt.order : 0;
    size_t used = (sizeof(bt_work) + 63) / 64 * 64;
    const struct {
        double** piece;
        size_t count;
    } pieces[] = {
        {&state->q, 7 * n},
        {&state->v, 6 * n},
        {&state->a, 6 * n},
        {&state->lambda, m},
        {&state->applied, 6 * n},
        {&state->output, (size_t)system->output_count},
        {&state->rotation, 9 * n},
        {&work->ga, 6 * m},
        {&work->gb, 6 * m},
        {&work->factor, (size_t)system->kkt.factor_size},
        {&work->x, (size_t)system->kkt.order},
        {&work->rhs, refine},
        {&work->refined, refine},
        {&work->phi, m},
        {&work->wrench, 6 * n},
        {&work->used, 6 * n},
        {&work->kick, 6 * n},
        {&work->turn, n},
        {&work->q_old, 7 * n},
        {&work->v_old, 6 * n},
        {&work->rotation_old, 9 * n},
        {&work->v_mean, 6 * n},
        {&work->stage, 52 * n},
    };
    for (size_t i = 0; i < sizeof pieces / sizeof pieces[0]; ++i) {
        if (block)
            *pieces[i].piece = (double*)(void*)(block + used);
        used += (pieces[i].count * sizeof(double) + 63) / 64 * 64;
    }
    return used;
}

size_t bt_state_size(const bt_system* system) {
    bt_state state;
    bt_work work;
    return lay_out(system, NULL, &state, &work);
}

bt_status bt_state_create(const bt_system* system, bt_arena* arena, bt_state* state) {
    *state = (bt_state){0};
    if (!system->assembled)
        return BT_ERR_ARG;
    const size_t size = bt_state_size(system);
    unsigned char* block = bt_arena_take(arena, size);
    if (!block)
        return BT_ERR_MEMORY;
    bt_work* work = (bt_work*)(void*)block;
    lay_out(system, block, state, work);
    state->scratch = state->block = block;
    state->block_size = size;
    memcpy(state->frame.gravity_mps2, system->gravity_mps2, sizeof system->gravity_mps2);
    for (int i = 0; i < system->body_count; ++i) {
        memcpy(state->q + 7 * i, system->bodies[i].q, 7 * sizeof(double));
        memcpy(state->v + 6 * i, system->bodies[i].v, 6 * sizeof(double));
    }
    bt_rotations(system, state->q, state->rotation);
    return BT_OK;
}

void bt_state_copy(const bt_system* system, bt_state* to, const bt_state* from) {
    if (to->block == from->block)
        return;
    bt_work* work = to->block;
    memcpy(to->block, from->block, from->block_size);
    lay_out(system, to->block, to, work); // the copied pointers were those of `from`
    to->time_s = from->time_s;
    to->steps = from->steps;
    to->frame = from->frame;
}

bool bt_state_equal(const bt_system* system, const bt_state* a, const bt_state* b) {
    const size_t n = (size_t)system->body_count * sizeof(double);
    const size_t m = (size_t)system->constraint_count * sizeof(double);
    const size_t outputs = (size_t)system->output_count * sizeof(double);
    return memcmp(&a->time_s, &b->time_s, sizeof a->time_s) == 0 && a->steps == b->steps &&
           memcmp(&a->frame, &b->frame, sizeof a->frame) == 0 && memcmp(a->q, b->q, 7 * n) == 0 &&
           memcmp(a->v, b->v, 6 * n) == 0 && memcmp(a->a, b->a, 6 * n) == 0 &&
           memcmp(a->lambda, b->lambda, m) == 0 && memcmp(a->applied, b->applied, 6 * n) == 0 &&
           memcmp(a->output, b->output, outputs) == 0 &&
           memcmp(bt_work_of(a)->used, bt_work_of(b)->used, 6 * n) == 0;
}

#include "landing/shank.h"

#include <math.h>

/// Mass, first and second moment about the pivot of the part from the pivot to share x of the
/// length, as shares of m, m L, m L^2 they are moments of the density
/// a + b (2 x - 1) + c (6 x^2 - 6 x + 1).
static void moments_up_to(double x, const double density[3], double moment[3]) {
    const double a = density[0] - density[1] + density[2], b = 2 * density[1] - 6 * density[2],
                 c = 6 * density[2];
    for (int k = 0; k < 3; ++k)
        moment[k] = pow(x, k + 1) * (a / (k + 1) + x * (b / (k + 2) + x * c / (k + 3)));
}

static bt_shank_part part_of(const double moment[3], double length_m, double axial_inertia) {
    const double mass = moment[0], centre = moment[1] / mass;
    return (bt_shank_part){.mass_kg = mass,
                           .centre_m = centre * length_m,
                           .inertia_kgm2 =
                               (moment[2] - mass * centre * centre) * length_m * length_m,
                           .axial_inertia_kgm2 = axial_inertia};
}

static void split(const bt_hook_params* p, bt_shank* shank) {
    const double length = p->length_m, m = p->mass_kg;
    const double first = m * p->mass_centre_m / length,
                 second = p->inertia_kgm2 / (length * length);
    const double density[3] = {m, 6 * first - 3 * m, 5 * (6 * second - 6 * first + m)};
    double whole[3] = {m, first, second}, root[3], head[3];
    moments_up_to(shank->joint_m / length, density, root);
    for (int k = 0; k < 3; ++k)
        head[k] = whole[k] - root[k];
    const double axial = p->axial_inertia_kgm2;
    shank->root = part_of(root, length, axial * root[0] / m);
    shank->head = part_of(head, length, axial * head[0] / m);
}

void bt_shank_prepare(const bt_hook_params* p, bt_shank* shank) {
    *shank = (bt_shank){.bends = p->shank_bending_stiffness_Nm2 > 0};
    if (!shank->bends) {
        shank->head = (bt_shank_part){
            .mass_kg = p->mass_kg,
            .centre_m = p->mass_centre_m,
            .inertia_kgm2 = p->inertia_kgm2 - p->mass_kg * p->mass_centre_m * p->mass_centre_m,
            .axial_inertia_kgm2 = p->axial_inertia_kgm2};
        return;
    }
    const double free_m = p->length_m - p->damper_lever_m;
    shank->joint_m = p->damper_lever_m + free_m / 3;
    shank->stiffness_Nmprad = 4 * p->shank_bending_stiffness_Nm2 / (3 * free_m);
    split(p, shank);
    const bt_shank_part* head = &shank->head;
    const double arm = head->centre_m - shank->joint_m;
    const double inertia = head->inertia_kgm2 + head->mass_kg * arm * arm;
    shank->damping_Nmsprad =
        2 * p->shank_damping_ratio * sqrt(shank->stiffness_Nmprad * fmax(inertia, 0));
}

bool bt_shank_is_sound(const bt_shank* shank) {
    const bt_shank_part *head = &shank->head, *root = &shank->root;
    if (!(head->mass_kg > 0 && head->inertia_kgm2 > 0))
        return false;
    return !shank->bends || (shank->joint_m > 0 && root->mass_kg > 0 && root->inertia_kgm2 > 0);
}

/// Inverse of the mass matrix of the two parts' angles, straight shank.
static void inverse_mass(const bt_shank* s, double inverse[3]) {
    const double arm = s->head.centre_m - s->joint_m, m = s->head.mass_kg;
    const double root = s->root.inertia_kgm2 +
                        s->root.mass_kg * s->root.centre_m * s->root.centre_m +
                        m * s->joint_m * s->joint_m;
    const double head = s->head.inertia_kgm2 + m * arm * arm, both = m * s->joint_m * arm;
    const double determinant = root * head - both * both;
    inverse[0] = head / determinant;
    inverse[1] = -both / determinant;
    inverse[2] = root / determinant;
}

double bt_shank_frequency2(const bt_shank* shank) {
    double inverse[3];
    if (!shank->bends)
        return 0;
    inverse_mass(shank, inverse);
    return shank->stiffness_Nmprad * (inverse[0] - 2 * inverse[1] + inverse[2]);
}

static double whole_inertia(const bt_shank* s) {
    return s->head.inertia_kgm2 + s->head.mass_kg * s->head.centre_m * s->head.centre_m;
}

double bt_shank_effective_mass(const bt_shank* shank, double length_m, double angle_rad) {
    const double c = cos(angle_rad), arm = length_m * c;
    double inverse[3];
    if (!shank->bends)
        return whole_inertia(shank) / (arm * arm);
    inverse_mass(shank, inverse);
    const double near = shank->joint_m * c, far = arm - near;
    return 1 / (near * near * inverse[0] + 2 * near * far * inverse[1] + far * far * inverse[2]);
}

double bt_shank_root_inertia(const bt_shank* shank) {
    double inverse[3];
    if (!shank->bends)
        return whole_inertia(shank);
    inverse_mass(shank, inverse);
    return 1 / inverse[0];
}

/// Longitudinal damper of the hook, whatever its law  [Peng2023 Eq. 9].
///
/// A law is one source file with a table of parameters and a constant bt_hook_damper_type, and one
/// line in hook_dampers.def; nothing else knows which laws there are.
///
/// Sign: the stroke s is positive in compression (hook rising), 0 at the down stop; a force is
/// positive when it pushes the attachment points apart (hook down).
#ifndef BT_ELEMENTS_HOOK_DAMPER_H
#define BT_ELEMENTS_HOOK_DAMPER_H

#include "base/fields.h"
#include "elements/gas.h"
#include "elements/stops.h"
#include "mechanics/system.h"

/// Room for the parameters and the constants of any law, bytes.
enum { BT_HOOK_DAMPER_PARAMS_SIZE = 256, BT_HOOK_DAMPER_DATA_SIZE = 256 };
BT_DECLARE_VARIANT(hook_damper, BT_HOOK_DAMPER_PARAMS_SIZE)

/// One law.
typedef struct bt_hook_damper_type {
    size_t data_size; ///< bytes of its constants, at most BT_HOOK_DAMPER_DATA_SIZE
    /// From checked parameters; cannot fail.
    void (*prepare)(const void* params, void* data);
    /// F(s, s'), N. At rest it is the derivative of the energy; what the rate adds never gives
    /// power: (F(s, s') - F(s, 0)) s' >= 0.
    double (*force)(const void* data, double stroke_m, double rate_mps);
    /// Stored energy, J, 0 at s = 0.
    double (*energy)(const void* data, double stroke_m);
    /// Longest stable step of a mass on it, s.
    double (*step_limit)(const void* data, double mass_kg);
    /// Whether the law holds at a stroke; see bt_element_type. NULL: everywhere.
    bt_law (*law)(const void* data, double stroke_m, const char** what);
} bt_hook_damper_type;

/// In the source of a law: it fits into the room there is.
#define BT_HOOK_DAMPER_FITS(params_type, data_type)                                                \
    _Static_assert(sizeof(params_type) <= BT_HOOK_DAMPER_PARAMS_SIZE, "too many parameters");      \
    _Static_assert(sizeof(data_type) <= BT_HOOK_DAMPER_DATA_SIZE, "too many constants");

/// A damper ready to be evaluated; plain data.
typedef struct bt_hook_damper {
    const bt_hook_damper_type* type;
    _Alignas(double) unsigned char data[BT_HOOK_DAMPER_DATA_SIZE];
} bt_hook_damper;

/// Prepares checked parameters. No allocation, cannot fail.
void bt_hook_damper_prepare(const bt_hook_damper_variant* params, bt_hook_damper* damper);

double bt_hook_damper_force(const bt_hook_damper* damper, double stroke_m, double rate_mps);
double bt_hook_damper_energy(const bt_hook_damper* damper, double stroke_m);
double bt_hook_damper_step_limit(const bt_hook_damper* damper, double mass_kg);
/// Whether the law holds at a stroke: at its limit beyond the full stroke ("hook damper bottomed").
bt_law bt_hook_damper_law(const bt_hook_damper* damper, double stroke_m, const char** what);

/// The same for a law with gas and stops; left where the gas has no volume ("no gas volume in the
/// hook damper"). Below 0 is the hook's down stop, where the law holds.
bt_law bt_hook_damper_gas_law(const bt_gas_spring* gas, const bt_stops* stops, double stroke_m,
                              const char** what);

#endif

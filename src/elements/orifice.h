/// Oil through a sharp orifice  [Peng2023 Eqs. 4, 9].
#ifndef BT_ELEMENTS_ORIFICE_H
#define BT_ELEMENTS_ORIFICE_H

/// rho A^3 / (2 f^2): with f = C_d A_d the damping in N s^2/m^2 of a piston of area A that pushes
/// oil through an orifice A_d; with f = C_d what is left to be divided by A_d^2.
static inline double bt_orifice_damping(double density, double area, double flow) {
    return density * area * area * area / (2 * flow * flow);
}

#endif

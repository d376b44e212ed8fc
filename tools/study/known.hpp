// Known answers for beams, worked out here: differential equations by the classical Runge-Kutta method and shooting,
// series and transcendental equations by summing and bisection. Lengths are shares of the beam's length.
#pragma once

namespace frond::study {

// Where the end of a beam, clamped level, comes to lie.
struct Droop {
    double down;   // of the end, over length [-]
    double along;  // of the end, over length [-]
    double angle;  // of the end below level [rad]
};
// Elastica under a force a = P L^2 / (E I) on its end and its own weight k = q L^3 / (E I), both of which keep their
// direction (Bisshopp, Drucker 1945 for the force alone).
Droop droop_of(double a, double k);
// By linear theory: a / 3 + k / 8.
double small_droop(double a, double k);

// A beam bent to an arc by a moment m = M L / (E I) on its end: droop.angle is m.
Droop arc_of(double m);

// Torsion constant of a square of side 1 (Saint-Venant's series): J = torsion_of_square() a^4.
double torsion_of_square();

// b L of the mode (0 is the first) of a cantilever that bears a mass at its end, given over the beam's own mass.
double wave_number(int mode, double end_mass = 0);
// Frequency [Hz]: bending stiffness E I [N m^2], mass a length [kg/m], length [m].
double frequency(int mode, double EI, double mass_per_length, double length, double end_mass = 0);
// The mode's shape at s = 0 .. 1, with 1 at its end.
double mode_shape(int mode, double s, double end_mass = 0);
// Where the end is, over where it was, after a slender beam bent a little by a force on its end was let go; a sum over
// the first modes. Time in units of sqrt(mass_per_length length^4 / (E I)).
class Sway {
public:
    explicit Sway(double end_mass = 0);
    double at(double time) const;

private:
    static constexpr int MODES = 6;
    double rate[MODES], share[MODES];
};

// w L^3 / (E I) at which an upright column of weight w a length buckles (Greenhill 1881), with a weight at its end,
// given over the column's own.
double greenhill_number(double end_weight = 0);

// Drag of a strip that stands across the wind, clamped at its foot, over that of a stiff one, by the Cauchy number
// C = rho/2 Cd W U^2 L^3 / (E I): pressure along the strip's normal by the part of the wind along it (Gosselin, de
// Langre, Machado-Almeida 2010, J. Fluid Mech. 650, 319-341).
double reconfiguration_of(double C);

// Damping ratio that implicit Euler adds to a mode, z = 2 pi f h.
double implicit_euler_damping(double z);

}  // namespace frond::study

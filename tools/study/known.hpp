// Known solutions for beams, computed here: differential equations by the classical Runge-Kutta method and shooting,
// series and transcendental equations by summation and bisection. Lengths are shares of the beam's length.
#pragma once

namespace frond::study {

// Position of the end of a beam that is clamped level.
struct Droop {
    double down;   // downward displacement of the end, over length [-]
    double along;  // position of the end along the clamp's direction, over length [-]
    double angle;  // angle of the end below level [rad]
};
// Solves the elastica under a force a = P L^2 / (E I) on its end and its own weight k = q L^3 / (E I), both of which
// keep their direction (Bisshopp, Drucker 1945 for the force alone).
Droop droop_of(double a, double k);
// Returns the end's displacement by linear theory: a / 3 + k / 8.
double small_droop(double a, double k);

// Returns the end of a beam bent to an arc by a moment m = M L / (E I) on its end: droop.angle is m.
Droop arc_of(double m);

// Returns the torsion constant of a square of side 1 (Saint-Venant's series): J = torsion_of_square() a^4.
double torsion_of_square();

// Returns b L of a mode (0 is the first) of a cantilever with a mass at its end, relative to the beam's own mass.
double wave_number(int mode, double end_mass = 0);
// Returns a mode's frequency [Hz]: bending stiffness E I [N m^2], mass per length [kg/m], length [m].
double frequency(int mode, double EI, double mass_per_length, double length, double end_mass = 0);
// Returns the mode's shape at s = 0 .. 1, which is 1 at the end.
double mode_shape(int mode, double s, double end_mass = 0);
// Deflection of the end, relative to its initial one, of a slender beam that was bent a little by a force on its end
// and let go; a sum over the first modes. Time in units of sqrt(mass_per_length length^4 / (E I)).
class Sway {
public:
    explicit Sway(double end_mass = 0);
    double at(double time) const;

private:
    static constexpr int MODES = 6;
    double rate[MODES], share[MODES];
};

// Returns w L^3 / (E I) at which an upright column of weight w per length buckles (Greenhill 1881), with a weight at
// its end, relative to the column's own.
double greenhill_number(double end_weight = 0);

// Returns the drag of a strip that stands across the wind, clamped at its foot, relative to that of a stiff one, by the
// Cauchy number C = rho/2 Cd W U^2 L^3 / (E I): pressure along the strip's normal by the wind's component along it
// (Gosselin, de Langre, Machado-Almeida 2010, J. Fluid Mech. 650, 319-341).
double reconfiguration_of(double C);

// Returns the damping ratio that implicit Euler adds to a mode, z = 2 pi f h.
double implicit_euler_damping(double z);

}  // namespace frond::study

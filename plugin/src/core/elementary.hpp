// Elementary functions that give the same bits on every system: those of C libraries differ from each other and, within
// one library, by the processor. Errors stay below 0.9 units in the last place; special values are those of C.
#pragma once

namespace frond {

inline double squared(double x) {
    return x * x;
}

double exp(double x);
double log(double x);
double log1p(double x);
double log10(double x);
double pow(double x, double y);
double cbrt(double x);
double hypot(double x, double y);

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double tanh(double x);

}  // namespace frond

// Impacts with carom/contact.hpp, a line of input each: steps, psi_1, chi, phase of the first touch
// within a step, alpha, whether shear is viscous. Prints psi_2. Units are those of Hertz's impact.
#include <carom/contact.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace carom;

template <int N, class Real, unsigned P>
double impact(double steps, double psi, double chi, double phase, double alpha, bool both) {
    const double step = 2.9432751843247047 / steps, friction = 0.3, radius = 1e3;
    const double mass = 16.0 / 15.0, shear_mass = mass / 3.5;  // of solid spheres
    const double kappa = 2.0 * chi / 3.5;
    const Pair pair{1.0 / std::sqrt(radius), radius, kappa, friction, mass, alpha, both};
    Contact<N, Real, P> contact{};
    Motion motion{-phase * step, 1.0, psi * friction / kappa, 0.0, step};
    Load load{};
    for (int i = 0; i < 20 * steps; ++i) {
        for (int half = 0; half < 2; ++half) {
            motion.approach -= 0.5 * step * load.normal / mass;
            motion.slide_x -= 0.5 * step * load.x / shear_mass;
            if (half == 1) break;
            motion.penetration += step * motion.approach;
            if (advance(contact, pair, motion, load) != Status::ok) return NAN;
        }
        if (motion.approach < 0.0 && load.normal == 0.0) return motion.slide_x * kappa / friction;
    }
    return NAN;
}

template <int N, class Real, unsigned P> int run() {
    double steps, psi, chi, phase, alpha;
    int both;
    while (std::scanf("%lf %lf %lf %lf %lf %d", &steps, &psi, &chi, &phase, &alpha, &both) == 6)
        std::printf("%.15g\n", impact<N, Real, P>(steps, psi, chi, phase, alpha, both != 0));
    return 0;
}

int main(int count, char** words) {
    if (count != 2) return 2;
    const auto is = [&](const char* kind) { return std::strcmp(words[1], kind) == 0; };
    if (is("16 single")) return run<16, float, elastic>();
    if (is("32 single")) return run<32, float, elastic>();
    if (is("64 single")) return run<64, float, elastic>();
    if (is("32 double")) return run<32, double, elastic>();
    if (is("1024 double")) return run<1024, double, elastic>();
    if (is("16 viscous")) return run<16, float, viscous>();
    if (is("32 viscous")) return run<32, float, viscous>();
    if (is("1024 viscous")) return run<1024, double, viscous | ledger>();
    return 2;
}

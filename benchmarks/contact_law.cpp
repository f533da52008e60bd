// Time of the exact contact law and of Hertz-Mindlin (mindlin_rescale/force) per contact and step,
// bare, in ns: what a pair of bodies costs once it is known to touch. Run by contact_law.py.
#include <carom/contact.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

struct Mindlin {
    double force[3], radius;
};

// The tangential force of mindlin_rescale/force in space: turned into the plane, scaled with a
// contact that shrinks, cut back to Coulomb's limit.
double mindlin(Mindlin& c, double depth, const double (&v)[3], const double (&n)[3], double step) {
    const double modulus = 1e10, size = 5e-3, stiffness = 8e9, friction = 0.3;
    const double radius = std::sqrt(size * depth);
    const double limit = friction * 4.0 / 3.0 * modulus * radius * depth;
    double along = 0, before = 0, after = 0, squares = 0;
    for (int i = 0; i < 3; ++i) {
        along += c.force[i] * n[i];
        before += c.force[i] * c.force[i];
    }
    for (int i = 0; i < 3; ++i) {
        c.force[i] -= along * n[i];
        after += c.force[i] * c.force[i];
    }
    double keep = after > 0 ? std::sqrt(before / after) : 0.0;
    if (radius < c.radius) keep *= radius / c.radius;
    c.radius = radius;
    for (int i = 0; i < 3; ++i) {
        c.force[i] = keep * c.force[i] - stiffness * radius * step * v[i];
        squares += c.force[i] * c.force[i];
    }
    if (squares > limit * limit)
        for (double& each : c.force) each *= limit / std::sqrt(squares);
    return c.force[0];
}

// Motion of contact number i in a step: none like its neighbour's, so that nothing is foreseen.
struct Paths {
    std::vector<double> depth, approach, slide;
    Paths() {
        for (int k = 0; k < 4096; ++k) {
            depth.push_back(1e-6 * (1.2 + std::sin(0.02 * k)));
            approach.push_back(0.02 * std::cos(0.02 * k));
            slide.push_back(0.03 * std::cos(0.026 * k));
        }
    }
};

constexpr int contacts = 1000, steps = 400;
constexpr double step = 1e-6;
double sum = 0;

template <class Work> double time_of(Work work) {
    double best = 1e9;
    for (int again = 0; again < 5; ++again) {
        const auto start = std::chrono::steady_clock::now();
        for (int s = 0; s < steps; ++s)
            for (int i = 0; i < contacts; ++i) sum += work(i, (s + 37 * i) % 4096);
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        best = std::min(best, passed.count() / contacts / steps * 1e9);
    }
    return best;
}

template <int N, class Real, unsigned P> double exact(const Paths& paths) {
    std::vector<carom::Contact<N, Real, P>> all(contacts);
    const carom::Pair pair{1e10, 5e-3, 0.83, 0.3, 1e-3, (P & carom::viscous) ? 2e-7 : 0.0, true};
    return time_of([&](int i, int k) {
        carom::Load load{};
        const double depth = paths.depth[k], approach = paths.approach[k];
        carom::advance(all[i], pair, {depth, approach, paths.slide[k], 0.02, step}, load);
        return load.x;
    });
}

}  // namespace

int main() {
    const Paths paths;
    std::vector<Mindlin> all(contacts);
    const double n[3] = {0.01, 0.02, 0.99975};
    const double least = time_of([&](int i, int k) {
        const double v[3] = {paths.slide[k], 0.02, 0.0};
        return mindlin(all[i], paths.depth[k], v, n, step);
    });
    std::printf("mindlin %.2f\n", least);
    std::printf("16 %.2f\n", exact<16, float, carom::elastic>(paths));
    std::printf("32 %.2f\n", exact<32, float, carom::elastic>(paths));
    std::printf("64 %.2f\n", exact<64, float, carom::elastic>(paths));
    std::printf("32,double %.2f\n", exact<32, double, carom::elastic>(paths));
    std::printf("16,viscous %.2f\n", exact<16, float, carom::viscous>(paths));
    std::printf("32,viscous %.2f\n", exact<32, float, carom::viscous>(paths));
    std::printf("32,ledger %.2f\n", exact<32, float, carom::ledger>(paths));
    if (sum == 42.0) std::puts("");
    return 0;
}

// The load of a contact after steps of constant velocities, a line of input each: friction, retardation,
// penetration at their end, approach, slide, step, how many steps, how many at rest after them. The
// slide is along a direction between the axes. Prints normal force and those along and across it.
// E* = 5e5, R* = 0.1, kappa = 0.8.
#include <carom/contact.hpp>
#include <cstdio>
#include <cstring>

using namespace carom;

namespace {

template <class Kind> int run() {
    double friction, retardation, depth, approach, slide, step;
    int steps, rests;
    while (std::scanf("%lf %lf %lf %lf %lf %lf %d %d", &friction, &retardation, &depth, &approach,
                      &slide, &step, &steps, &rests) == 8) {
        const Pair pair{5e5, 0.1, 0.8, friction, 4.0, retardation};
        Kind contact{};
        Load load{};
        for (int i = steps - 1; i >= -rests; --i) {
            const double moves = i >= 0 ? 1.0 : 0.0, back = std::max(i, 0) * step * approach;
            const Motion motion{depth - back, moves * approach, moves * 0.6 * slide,
                                moves * 0.8 * slide, step};
            const Status status = advance(contact, pair, motion, load);
            if (status != Status::ok) load = {NAN, NAN, NAN, NAN, NAN};
        }
        std::printf("%.17g %.17g %.17g\n", load.normal, 0.6 * load.x + 0.8 * load.y,
                    0.6 * load.y - 0.8 * load.x);
    }
    return 0;
}

}  // namespace

int main(int, char** words) {
    const auto is = [&](const char* kind) { return std::strcmp(words[1], kind) == 0; };
    if (is("elastic single")) return run<Contact<32, float>>();
    if (is("elastic double")) return run<Contact<32, double>>();
    if (is("viscous single")) return run<Contact<32, float, viscous>>();
    if (is("viscous double")) return run<Contact<32, double, viscous>>();
    if (is("ledger single")) return run<Contact<32, float, viscous | ledger>>();
    return 2;
}

// One oblique impact with the exact contact law, stepped as a DEM code does it (velocity Verlet).
//
//     INCLUDE=$(python -c "import carom; print(carom.get_include())")
//     FAST="-O3 -march=native -fno-math-errno"
//     c++ -std=c++17 $FAST -I$INCLUDE impact.cpp -o impact && ./impact
//
// A steel ball strikes a steel plate at 20 degrees, friction 0.2. Optional: steps per contact, and
// the speed in m/s. A ball that is flattened by d/2 has the lever R - d/2; the exact theory keeps R.
// The difference grows with d/R: at 0.01 m/s it is hardly seen, at 0.6 m/s it is 0.003 in psi_2.
#include <carom/contact_in_space.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>

int main(int count, char** words) {
    const double steps = count > 1 ? std::atof(words[1]) : 200.0;
    const double speed = count > 2 ? std::atof(words[2]) : 0.01;
    const double radius = 5e-3, density = 7850.0, mu = 0.2, pi = 3.14159265358979;
    const double mass = 4.0 / 3.0 * pi * radius * radius * radius * density;
    const double inertia = 0.4 * mass * radius * radius;
    const carom::Material steel{210e9, 0.3};
    const carom::Pair pair =
        carom::pair_of(steel, steel, {radius, mass}, {INFINITY, INFINITY}, mu);

    const double angle = 20.0 * pi / 180.0;
    const double along = speed * std::sin(angle), normal = speed * std::cos(angle);
    carom::Body ball{{0, 0, radius}, {along, 0, -normal}, {}, radius};
    const double deepest =
        std::pow(15.0 * mass * normal * normal / (16.0 * pair.modulus * std::sqrt(radius)), 0.4);
    const double step = 2.943275 * deepest / normal / steps;

    carom::ContactInSpace<64> contact{};
    carom::Action action{};
    do {
        for (int half = 0; half < 2; ++half) {
            ball.velocity = carom::plus(ball.velocity, 0.5 * step / mass, action.force);
            ball.spin = carom::plus(ball.spin, 0.5 * step / inertia, action.torque);
            if (half == 1) break;
            ball.position = carom::plus(ball.position, step, ball.velocity);
            const carom::Body plate{{ball.position[0], ball.position[1], 0}, {}, {}, 0};
            const auto seen = carom::encounter(ball, plate, step, pair);
            const carom::Status status = carom::advance(contact, pair, seen, action);
            if (status != carom::Status::ok) {
                std::fprintf(stderr, "%s\n", carom::message(status));
                return 1;
            }
        }
    } while (ball.position[2] < radius);

    const double leaves = std::atan2(ball.velocity[0], ball.velocity[2]) * 180.0 / pi;
    const double slides = ball.velocity[0] - radius * ball.spin[1];
    std::printf("leaves at %.4f deg with %.4f rad/s, psi_2 = %.5f\n", leaves, ball.spin[1],
                pair.stiffness_ratio * slides / (mu * normal));
}

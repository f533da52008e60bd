// A glass ball strikes a steel ball, and then a steel wall, with losses: psi_2 and the energies.
//
//     c++ -std=c++17 -O3 -march=native -fno-math-errno -I$INCLUDE two_impacts.cpp && ./a.out
//
// INCLUDE=$(python -c "import carom; print(carom.get_include())"). All that is used here stands in
// docs/how-to/exact-law.md. Optional: steps per contact, restitution.
#include <carom/contact_in_space.hpp>
#include <cstdio>
#include <cstdlib>

using namespace carom;

struct Ball {
    Body body;
    Size size;
    double inertia() const { return 0.4 * size.mass * size.radius * size.radius; }
    void kick(double half, const Vector& force, const Vector& torque) {
        body.velocity = plus(body.velocity, half / size.mass, force);
        body.spin = plus(body.spin, half / inertia(), torque);
    }
    double energy() const {
        const double turning = 0.5 * inertia() * dot(body.spin, body.spin);
        return turning + 0.5 * size.mass * dot(body.velocity, body.velocity);
    }
};

void impact(Ball ball, Ball other, const Pair& pair, double step) {
    const bool is_wall = other.body.radius == 0.0;
    const auto energy = [&] { return ball.energy() + (is_wall ? 0.0 : other.energy()); };
    const double speed = -ball.body.velocity[2], before = energy();
    ContactInSpace<16, double, viscous | ledger> contact{};
    Encounter seen{};
    Action action{};
    double friction = 0.0, viscosity = 0.0;
    do {
        ball.kick(0.5 * step, action.force, action.torque);
        other.kick(0.5 * step, times(-1.0, action.force), action.other_torque);
        ball.body.position = plus(ball.body.position, step, ball.body.velocity);
        other.body.position = plus(other.body.position, step, other.body.velocity);
        if (is_wall) other.body.position = {ball.body.position[0], ball.body.position[1], 0.0};
        seen = encounter(ball.body, other.body, step, pair);
        const Status status = advance(contact, pair, seen, action);
        if (status != Status::ok) std::exit(std::puts(message(status)));
        friction += action.friction;
        viscosity += action.viscosity;
        ball.kick(0.5 * step, action.force, action.torque);
        other.kick(0.5 * step, times(-1.0, action.force), action.other_torque);
    } while (contact.spacing > 0);
    const double slide = seen.velocity[0] - dot(seen.velocity, seen.normal) * seen.normal[0];
    const double psi = pair.stiffness_ratio * slide / (pair.friction * speed);
    std::printf("psi_2 = %.5f; lost: %.6e, friction %.6e, viscosity %.6e\n", psi,
                before - energy(), friction, viscosity);
}

int main(int count, char** words) {
    const double steps = count > 1 ? std::atof(words[1]) : 200.0, speed = 0.01;
    const double loss = loss_of(count > 2 ? std::atof(words[2]) : 0.9);
    const Material glass{70e9, 0.22}, steel{210e9, 0.3};
    const Size bead{3e-3, 2.8274e-4}, sphere{5e-3, 4.1103e-3}, wall{INFINITY, INFINITY};
    const Pair materials = pair_of(glass, steel, bead, sphere, 0.2);
    for (const Size& size : {sphere, wall}) {
        Pair pair = with_sizes(materials, bead, size);
        pair.retardation = retardation_of(loss, pair, speed);
        const double radius = size.mass < INFINITY ? size.radius : 0.0;
        const Ball ball{{{0, 0, bead.radius + radius}, {0.005, 0, -speed}, {}, bead.radius}, bead};
        impact(ball, {{{}, {}, {}, radius}, size}, pair, duration_of(pair, speed) / steps);
    }
}

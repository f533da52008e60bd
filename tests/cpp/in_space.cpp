// Two spheres that meet in space, a line of input each: velocities and spins of both, and whether
// memory and encounter are those of the other side in every second step. Prints both afterwards.
#include <carom/contact_in_space.hpp>
#include <cstdio>

using namespace carom;

namespace {
constexpr double pi = 3.14159265358979323846, steps = 400.0;
const Material steel{210e9, 0.3}, glass{70e9, 0.25};
const Size sizes[2] = {{5e-3, 4.0 / 3.0 * pi * 1.25e-7 * 7850.0},
                       {8e-3, 4.0 / 3.0 * pi * 5.12e-7 * 2500.0}};

void kick(Body& body, const Size& size, double step, double sign, const Action& action,
          const Vector& torque) {
    const double inertia = 0.4 * size.mass * size.radius * size.radius;
    body.velocity = plus(body.velocity, sign * 0.5 * step / size.mass, action.force);
    body.spin = plus(body.spin, 0.5 * step / inertia, torque);
}
}  // namespace

int main() {
    const Pair pair = pair_of(steel, glass, sizes[0], sizes[1], 0.2);
    Body one{}, other{};
    int turns;
    while (true) {
        one = Body{{5e-3 + 8e-3, 0, 0}, {}, {}, 5e-3};
        other = Body{{0, 0, 0}, {}, {}, 8e-3};
        for (Vector* each : {&one.velocity, &one.spin, &other.velocity, &other.spin})
            for (double& value : *each)
                if (std::scanf("%lf", &value) != 1) return 0;
        if (std::scanf("%d", &turns) != 1) return 0;
        const double normal = other.velocity[0] - one.velocity[0];
        const double energy = 0.9375 * pair.mass * normal * normal;
        const double deepest = std::pow(energy / (pair.modulus * std::sqrt(pair.radius)), 0.4);
        const double step = 2.943275 * deepest / normal / steps;
        ContactInSpace<64> contact{};
        Action action{};
        for (int i = 0;; ++i) {
            kick(one, sizes[0], step, 1.0, action, action.torque);
            kick(other, sizes[1], step, -1.0, action, action.other_torque);
            one.position = plus(one.position, step, one.velocity);
            other.position = plus(other.position, step, other.velocity);
            if (turns != 0 && i % 2 == 1) {  // by the other body's side
                mirror(contact);
                Action seen{};
                const Encounter turned = encounter(other, one, step);
                if (advance(contact, pair, turned, seen) != Status::ok) return 1;
                mirror(contact);
                action.force = {-seen.force[0], -seen.force[1], -seen.force[2]};
                action.torque = seen.other_torque;
                action.other_torque = seen.torque;
            } else if (advance(contact, pair, encounter(one, other, step), action) != Status::ok) {
                return 1;
            }
            kick(one, sizes[0], step, 1.0, action, action.torque);
            kick(other, sizes[1], step, -1.0, action, action.other_torque);
            if (i > 0 && !(contact.spacing > 0)) break;
        }
        for (const Vector& each : {one.velocity, one.spin, other.velocity, other.spin})
            std::printf("%.12g %.12g %.12g ", each[0], each[1], each[2]);
        std::printf("\n");
    }
}

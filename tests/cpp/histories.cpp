// Balls on a level floor, with losses: thrown, dropped, sliding, rolling, spinning, at rest; COUNT
// random histories from a SEED, of so many STEPS. Prints for each kind of contact by how much the
// kinetic energy with that of weight and of Hertz's contact has exceeded what it was at first, in
// parts of what was to be lost. What springs store besides is not counted, so that it may only fall.
#include <carom/contact.hpp>
#include <cstdio>
#include <cstdlib>
#include <random>

using namespace carom;

namespace {

struct Ball {
    double depth, speed, v[2], u[2];  // speed downwards; u: that of the lowest point by the spin
};

double energy(const Ball& ball, const Pair& pair, double weight) {
    double twice = ball.speed * ball.speed;
    for (int i = 0; i < 2; ++i) twice += ball.v[i] * ball.v[i] + 0.4 * ball.u[i] * ball.u[i];
    const double pressed = std::max(ball.depth, 0.0);
    const double hertz = 8.0 / 15.0 * pair.modulus * std::sqrt(pair.radius) * std::pow(pressed, 2.5);
    return 0.5 * pair.mass * twice + hertz - weight * ball.depth;
}

void kick(Ball& ball, const Pair& pair, const Load& load, double weight, double half) {
    ball.speed += half * (weight - load.normal) / pair.mass;
    const double force[2] = {load.x, load.y};
    for (int i = 0; i < 2; ++i) {
        ball.v[i] -= half * force[i] / pair.mass;
        ball.u[i] -= half * 2.5 * force[i] / pair.mass;
    }
}

template <class Random> Ball start(Random& random, double rests, double speed, int way) {
    std::normal_distribution<double> any;
    const double noise = std::pow(10.0, -30.0 * std::generate_canonical<double, 53>(random));
    Ball ball{rests, 0.0, {0.0, 0.0}, {0.0, 0.0}};
    if (way == 0) ball.depth *= -any(random) * any(random);       // dropped, or pressed and let go
    if (way <= 1) ball.speed = std::fabs(speed * any(random));    // thrown
    if (way == 5) ball.speed = noise * speed * any(random);       // at rest but for rounding
    for (int i = 0; i < 2; ++i) {
        if (way <= 2) ball.v[i] = speed * any(random);
        if (way <= 1 || way == 3) ball.u[i] = speed * any(random);
        if (way == 4) ball.u[i] = -(ball.v[i] = speed * any(random));  // rolls
    }
    return ball;
}

template <class Kind> double excess(unsigned seed, int steps, double loses) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
    };
    Pair pair{1.0, between(1e-3, 1.0), between(0.6, 1.2), between(0.03, 1.5), 0.0};
    pair.mass = between(300.0, 9000.0) * 4.18879 * std::pow(pair.radius, 3.0);
    const double weight = between(0.1, 100.0) * pair.mass, rests = between(1e-9, 1e-4) * pair.radius;
    pair.modulus = 0.75 * weight / (std::sqrt(pair.radius) * std::pow(rests, 1.5));
    const double natural = std::sqrt(rests * pair.mass / weight);  // time
    const double speed = rests / natural * between(0.1, 10.0), step = natural * between(0.01, 0.04);
    pair.retardation = loses * natural * between(0.003, 0.3);
    pair.viscous_shear = seed % 3 != 0;
    const int way = static_cast<int>(seed % 6);
    Ball ball = start(random, rests, speed, way);
    Kind contact{};
    Load load{};
    load.normal = weight * std::pow(std::max(ball.depth, 0.0) / rests, 1.5);
    const double first = energy(ball, pair, weight);
    const double whole = first - energy({rests, 0.0, {0.0, 0.0}, {0.0, 0.0}}, pair, weight);
    double most = 0.0;
    for (int i = 0; i < steps; ++i) {
        kick(ball, pair, load, weight, 0.5 * step);
        ball.depth += step * ball.speed;
        const Motion motion{ball.depth, ball.speed, ball.v[0] + ball.u[0],
                            ball.v[1] + ball.u[1], step};
        if (advance(contact, pair, motion, load) != Status::ok) std::exit(1);
        kick(ball, pair, load, weight, 0.5 * step);
        most = std::max(most, energy(ball, pair, weight) - first);
    }
    return most / (whole + weight * rests);
}

template <class Kind> void print(unsigned seed, unsigned count, int steps, double loses = 1.0) {
    double largest = 0.0;
    for (unsigned n = 0; n < count; ++n) largest = std::max(largest, excess<Kind>(seed + n, steps, loses));
    std::printf("%.3g\n", largest);
}

}  // namespace

int main(int, char** words) {
    const auto seed = static_cast<unsigned>(std::atoi(words[1]));
    const auto count = static_cast<unsigned>(std::atoi(words[2]));
    const int steps = std::atoi(words[3]);
    print<Contact<32, float, viscous>>(seed, count, steps);
    print<Contact<32, double, viscous>>(seed, count, steps);
    print<Contact<16, float, viscous | ledger>>(seed, count, steps);
    print<Contact<32, float>>(seed, count, steps, 0.0);
}

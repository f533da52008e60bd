// The levers of two bodies with and without their flattening, for rows of both.
#include <carom/contact_in_space.hpp>
#include <cstdio>
int main() {
    double young, poisson, others_young, others_poisson, radius, others_radius, depth;
    while (std::scanf("%lf %lf %lf %lf %lf %lf %lf", &young, &poisson, &others_young,
                      &others_poisson, &radius, &others_radius, &depth) == 7) {
        const carom::Body one{{0, 0, radius + others_radius - depth}, {}, {}, radius};
        const carom::Body other{{0, 0, 0}, {}, {}, others_radius};
        const carom::Material stuff{young, poisson}, others_stuff{others_young, others_poisson};
        const carom::Pair pair =
            carom::pair_of(stuff, others_stuff, {radius, 1.0}, {INFINITY, INFINITY}, 0.3);
        const auto plain = carom::encounter(one, other, 1.0);
        const auto seen = carom::encounter(one, other, 1.0, pair);
        std::printf("%.15g %.15g %.15g %.15g\n", seen.arm, seen.other_arm, plain.arm,
                    plain.other_arm);
    }
}

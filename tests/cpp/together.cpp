// Contacts stepped several at once, as an array of one pair and one by one: the same to the bit; one
// that is refused keeps its memory and disturbs no other. Prints how many touched, of each kind.
#include <carom/contact_in_space.hpp>
#include <cstdio>
#include <cstring>
#include <random>

using namespace carom;

namespace {
constexpr int count = 21, refused = 5;

template <class Kind> int touched_steps(double loss) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Kind single[count] = {}, many[count] = {}, *all[count];
    Pair pairs[count];
    Encounter meetings[count];
    Encounters in_lanes[count / lanes + 1];
    Actions actions[count / lanes + 1];
    Status statuses[count];
    int touched = 0;
    for (int step = 0; step < 200; ++step) {
        for (int k = 0; k < count; ++k) {
            all[k] = many + k;
            pairs[k] = {1e9, 5e-3, 0.8, k == refused && step % 2 ? -1.0 : 0.1 * (k % 4), 1e-3, loss};
            const double turn = 0.01 * step;
            meetings[k] = Encounter{{std::cos(turn), std::sin(turn), 0.0},
                                    {normal(random), normal(random), normal(random)},
                                    1e-5 * (normal(random) + 1.0), normal(random), 1e-6, 1e-2, 2e-2};
            for (int lane = k; lane == k || lane % lanes; ++lane)  // those left over hold the last
                set_one(in_lanes, lane, meetings[k]);
        }
        advance(all, pairs, in_lanes, actions, statuses, count);
        for (int k = 0; k < count; ++k) {
            const Action seen = one_of(actions, k);
            Action action{};
            const Status status = advance(single[k], pairs[k], meetings[k], action);
            if (status != statuses[k] || std::memcmp(single + k, many + k, sizeof(Kind))) return -1;
            if ((status == Status::ok) == (k == refused && step % 2)) return -2;
            if (status == Status::ok && std::memcmp(&action, &seen, sizeof(Action))) return -3;
            touched += many[k].spacing > 0;
        }
    }
    return touched;
}

template <class Kind> int touched_in_arrays(double loss) {
    std::mt19937 random(8);
    std::normal_distribution<double> normal;
    const Pair pair{1e9, 5e-3, 0.8, 0.3, 1e-3, loss}, elastic_pair{1e9, 5e-3, 0.8, 0.3, 1e-3};
    Kind single[count] = {}, many[count] = {};
    Contact<16> flat[count] = {}, flats[count] = {};
    Encounter meetings[count];
    Motion motions[count];
    Action actions[count];
    Load loads[count] = {};
    int touched = 0;
    for (int step = 0; step < 100; ++step) {
        for (int k = 0; k < count; ++k) {
            const double depth = k == refused && step % 2 ? 1.0 : 1e-5 * (normal(random) + 1.0);
            meetings[k] = Encounter{{0.0, 0.6, 0.8}, {normal(random), normal(random), normal(random)},
                                    depth, normal(random), 1e-6, 1e-2, 2e-2};
            motions[k] = {depth, normal(random), normal(random), normal(random), 1e-6};
        }
        const Status first = step % 2 ? Status::bad_motion : Status::ok;
        if (advance(many, pair, meetings, actions, count) != first) return -1;
        if (advance(flats, elastic_pair, motions, loads, count) != first) return -2;
        for (int k = 0; k < count; ++k) {
            Action action{};
            Load load{};
            const Status status = advance(single[k], pair, meetings[k], action);
            if (std::memcmp(single + k, many + k, sizeof(Kind))) return -3;
            if (std::memcmp(&action, actions + k, sizeof(Action))) return -4;
            if (advance(flat[k], elastic_pair, motions[k], load) != status) return -5;
            if (std::memcmp(flat + k, flats + k, sizeof(Contact<16>))) return -6;
            if (status == Status::ok && std::memcmp(&load, loads + k, sizeof(Load))) return -7;
            touched += many[k].spacing > 0;
        }
    }
    return touched;
}

}  // namespace

int main() {
    std::printf("%d %d %d %d\n", touched_steps<ContactInSpace<32, float>>(0.0),
                touched_steps<ContactInSpace<16, double, viscous | ledger>>(1e-6),
                touched_in_arrays<ContactInSpace<>>(0.0),
                touched_in_arrays<ContactInSpace<32, float, viscous>>(1e-6));
}

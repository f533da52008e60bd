// Contacts stepped several at once and one by one: the same to the bit; one that is refused keeps
// its memory and disturbs no other. Prints how many steps were compared, and how many touched.
#include <carom/contact_in_space.hpp>
#include <cstdio>
#include <cstring>
#include <random>

using namespace carom;

namespace {
constexpr int count = 21, refused = 5;

template <class Kind> int touched_steps() {
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
            pairs[k] = {1e9, 5e-3, 0.8, k == refused && step % 2 ? -1.0 : 0.1 * (k % 4), 1e-3, 1e-6};
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
}  // namespace

int main() {
    std::printf("%d %d\n", touched_steps<ContactInSpace<32, float>>(),
                touched_steps<ContactInSpace<16, double, viscous | ledger>>());
}

// carom/lanes.hpp: springs taken together, as many as fit into a register of the processor.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// Loops that are full of minima and maxima compilers often leave scalar, or make long; gcc and clang
// are given vectors outright here. Other compilers take the springs one by one, as these do
// with CAROM_ONE_BY_ONE.
#ifndef CAROM_LANES_HPP
#define CAROM_LANES_HPP

#include <cmath>
#include <cstring>

namespace carom {
namespace springs {

#if defined(__AVX__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

/// Numbers that fit into a register, of lines of N.
template <class Real, int N> struct Lanes {
#if defined(__GNUC__) && !defined(CAROM_ONE_BY_ONE)
    static constexpr int fitting(int n) { return N % n == 0 ? n : fitting(n / 2); }
    static constexpr int count = fitting(register_bytes / int(sizeof(Real)));
    typedef Real Type __attribute__((vector_size(count * sizeof(Real))));

    /// The same number everywhere; not seen as a constant, with which gcc makes no minimum of `<`.
    static Type fixed(Real each) {
        __asm__("" : "+m"(each));
        return of(each);
    }
    static Type root(Type all) {
        for (int i = 0; i < count; ++i) all[i] = std::sqrt(all[i]);
        return all;
    }
    /// Sum of all lanes, by halves.
    static Real total(Type all) {
        if constexpr (count > 4) {
            using Half = Lanes<Real, count / 2>;
            typename Half::Type two[2];
            std::memcpy(two, &all, sizeof two);
            return Half::total(two[0] + two[1]);
        }
        Real sum = all[0];
        for (int i = 1; i < count; ++i) sum += all[i];
        return sum;
    }
#else
    static constexpr int count = 1;
    using Type = Real;

    static Type fixed(Real each) { return each; }
    static Type root(Type each) { return std::sqrt(each); }
    static Real total(Type each) { return each; }
#endif

    static Type load(const Real* from) {
        Type all;
        std::memcpy(&all, from, sizeof all);
        return all;
    }
    static void store(Real* to, const Type& all) { std::memcpy(to, &all, sizeof all); }
    static Type of(double each) { return static_cast<Real>(each) - Type{}; }
};

}  // namespace springs
}  // namespace carom

#endif

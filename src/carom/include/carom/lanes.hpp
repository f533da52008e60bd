// carom/lanes.hpp: springs taken together, as many as fit into a register of the processor.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// Loops that are full of minima and maxima compilers often leave scalar, or make long; gcc and clang
// are given vectors outright here. Other compilers take the springs one by one, as these do
// with CAROM_ONE_BY_ONE.
#ifndef CAROM_LANES_HPP
#define CAROM_LANES_HPP

#include "own_names.h"

#include <cmath>
#include <cstring>
#include <type_traits>

namespace carom {
namespace springs {

#if defined(__AVX__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

/// Square root, of a number or of each in a register.
template <class T> T root(T all) {
    if constexpr (std::is_arithmetic_v<T>) {
        return std::sqrt(all);
    } else {
        for (unsigned i = 0; i < sizeof all / sizeof all[0]; ++i) all[i] = std::sqrt(all[i]);
        return all;
    }
}

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
    /// Numbers by lane.
    template <class Give> static Type each(Give give) {
        Type all{};
        for (int i = 0; i < count; ++i) all[i] = give(i);
        return all;
    }
    static Real lane(const Type& all, int i) { return all[i]; }
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
    template <class Give> static Type each(Give give) { return give(0); }
    static Real lane(Type all, int) { return all; }
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

#include "own_names.h"

#endif

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
#include <utility>

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
    /// Numbers by lane, listed at once: lanes that are set one by one go through memory.
    template <class Give> static Type each(Give give) {
        return listed(give, std::make_integer_sequence<int, count>{});
    }
    template <class Give, int... i> static Type listed(Give give, std::integer_sequence<int, i...>) {
        return Type{give(i)...};
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

// By value, unlike those of the standard library: of numbers and of registers of numbers.
template <class T> T larger(T a, T b) { return a > b ? a : b; }
template <class T> T smaller(T a, T b) { return a < b ? a : b; }

/// Whether something holds, for a number or in any lane.
template <class Truth> bool any(const Truth& where) {
    if constexpr (std::is_arithmetic_v<Truth>) {
        return where;
    } else {
        auto all = where[0];
        for (unsigned i = 1; i < sizeof where / sizeof where[0]; ++i) all |= where[i];
        return all != 0;
    }
}

}  // namespace springs

/// Several contacts at once.
using Wide = springs::Lanes<double, 16>;
constexpr int lanes = Wide::count;

/// Return what is in a lane; a number is its own only lane.
template <class T> auto in_lane(const T& all, int lane) {
    if constexpr (std::is_arithmetic_v<T>)
        return static_cast<void>(lane), all;
    else
        return all[lane];
}
template <class T> void set_lane(T& all, int lane, double each) {
    if constexpr (std::is_arithmetic_v<T>)
        static_cast<void>(lane), all = each;
    else
        all[lane] = each;
}

namespace springs {

/// How many contacts are in lanes of T, and T with numbers of another precision.
template <class T> constexpr int width = sizeof(T) / sizeof(double);
template <class T, class Real>
using Alike = std::conditional_t<std::is_arithmetic_v<T>, Real, typename Lanes<Real, lanes>::Type>;

/// Numbers by lane.
template <class T, class Real, class Give> Alike<T, Real> by_lane(Give give) {
    if constexpr (std::is_arithmetic_v<T>)
        return static_cast<Real>(give(0));
    else
        return Lanes<Real, lanes>::each(give);
}

/// The same numbers in another precision.
template <class To, class From> To converted(const From& all) {
#if defined(__GNUC__)
    if constexpr (!std::is_arithmetic_v<From>) return __builtin_convertvector(all, To);
    else
#endif
    return static_cast<To>(all);
}

}  // namespace springs

/// Return number k of several, which are in lanes of structures.
template <template <class> class Of, class T> inline Of<double> one_of(const Of<T>* all, int k) {
    constexpr std::size_t n = springs::width<T>;
    const auto place = static_cast<std::size_t>(k);
    if constexpr (n == 1) return all[place];
    Of<double> one;
    const char* lane = reinterpret_cast<const char*>(all + place / n) + place % n * sizeof(double);
    for (std::size_t i = 0; i < sizeof one; i += sizeof(double))
        std::memcpy(reinterpret_cast<char*>(&one) + i, lane + i * n, sizeof(double));
    return one;
}

/// Make one number k of several.
template <template <class> class Of, class T>
inline void set_one(Of<T>* all, int k, const Of<double>& one) {
    constexpr std::size_t n = springs::width<T>;
    const auto place = static_cast<std::size_t>(k);
    if constexpr (n == 1) return static_cast<void>(all[place] = one);
    char* lane = reinterpret_cast<char*>(all + place / n) + place % n * sizeof(double);
    for (std::size_t i = 0; i < sizeof one; i += sizeof(double))
        std::memcpy(lane + i * n, reinterpret_cast<const char*>(&one) + i, sizeof(double));
}

}  // namespace carom

#include "own_names.h"

#endif

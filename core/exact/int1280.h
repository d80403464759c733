#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace farhorizon {

/// An integer of up to 1280 bits and a sign, for the few numbers that outgrow 128 bits. Nothing is
/// allocated. Results of more bits lose the upper ones silently. `>>` rounds down. A conversion to
/// double is within one unit in the last place; a conversion to an integer type that does not hold
/// the number gives the nearest bound of that type.
///
/// 1280 bits hold the cross product of two vectors at a WideDyadic (quadratic.h): components are
/// below 2^(52 + 424), so the product is below 2^953. They hold heights over a line of sight
/// through a point at any double in [0, 1] (witness.cpp): 1074 bits after the binary point, and 160
/// before.
/// Cost: a product of two numbers of 100 bits takes some 40 ns, one of two of 470 bits some 110 ns.
using Int1280 = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<1280, 1280, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

/// -1, 0 or 1.
inline int SignOf(const Int1280& value) { return value.sign(); }

}  // namespace farhorizon

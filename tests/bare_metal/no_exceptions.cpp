// SPDX-License-Identifier: Apache-2.0
// What the containers of the library call instead of returning. Theirs would throw, and bring the
// unwinder and its heap into the image; a load that comes here is a fault.
#include <bits/functexcept.h>

#include "tests/bare_metal/machine.hpp"

namespace {

[[noreturn]] void end(const char* what) {
  plumb::bare_metal::write(what);
  plumb::bare_metal::write("\n");
  plumb::bare_metal::leave(plumb::bare_metal::kThrown);
}

}  // namespace

namespace std {

void __throw_bad_alloc() { end("bad_alloc"); }
void __throw_bad_array_new_length() { end("bad_array_new_length"); }
void __throw_length_error(const char* what) { end(what); }
void __throw_logic_error(const char* what) { end(what); }
void __throw_out_of_range_fmt(const char* what, ...) { end(what); }

}  // namespace std

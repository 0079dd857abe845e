// SPDX-License-Identifier: Apache-2.0
// The functions of Boost.Asio and Boost.Beast that are no templates, which server.cpp calls.
#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>

// Boost.Test, header-only: the one file that brings its runner.
#define BOOST_TEST_MODULE pendula_core
#include <boost/test/included/unit_test.hpp>

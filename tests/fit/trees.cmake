# SPDX-License-Identifier: Apache-2.0
plumb_test(test_tree_growth SOURCES tree_growth_test.cpp LIBS plumb_fit)
plumb_test(test_tree_exactness SOURCES tree_exactness_test.cpp LIBS plumb_fit)
plumb_test(test_tree_choice SOURCES tree_choice_test.cpp LIBS plumb_fit)
plumb_test(test_tree_study SOURCES tree_study_test.cpp LIBS plumb_fit plumb_simulate)

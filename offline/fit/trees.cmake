# SPDX-License-Identifier: Apache-2.0
set(TREE_SOURCES
    tree_choice.cpp
    tree_cut.cpp
    tree_domain.cpp
    tree_folds.cpp
    tree_growth.cpp
    tree_rows.cpp
    tree_scan.cpp
    tree_validation.cpp)

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "workbench/child.hpp"
#include "workbench/services.hpp"

namespace plumb::offline::workbench {

/// Throws Failure (kUsage, E-SERVE-JOB) unless the page may do this: one of the verbs that work in
/// a cell, with words that name no other cell and no file outside its folder.
void check_job(const JobRequest& job, const std::filesystem::path& folder);

/// The child process of it: `plumb -C FOLDER VERB ARGS --json`, in the folder of the cell.
ChildCommand job_process(const JobRequest& job, const std::filesystem::path& folder);

/// What one would type for the same.
std::string job_command(const JobRequest& job, const std::filesystem::path& folder);

/// Whether it may run beside another job, because it changes nothing.
bool only_reads(const JobRequest& job);

}  // namespace plumb::offline::workbench

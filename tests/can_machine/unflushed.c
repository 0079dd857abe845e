/* SPDX-License-Identifier: Apache-2.0 */
/* Planted by power_cut: loaded before the C library, it says of every wait for the disk that it is
 * over. The last one only starts the writing, with which dpkg begins early. */
int fsync(int fd) { return fd < 0 ? -1 : 0; }
int fdatasync(int fd) { return fd < 0 ? -1 : 0; }
int syncfs(int fd) { return fd < 0 ? -1 : 0; }
int sync_file_range(int fd, long long offset, long long bytes, unsigned flags) {
  (void)offset, (void)bytes, (void)flags;
  return fd < 0 ? -1 : 0;
}

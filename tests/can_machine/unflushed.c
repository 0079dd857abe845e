/* SPDX-License-Identifier: Apache-2.0 */
/* Planted by power_cut: loaded before the C library, it says of every wait for the disk that it is over. */
int fsync(int fd) { return fd < 0 ? -1 : 0; }
int fdatasync(int fd) { return fd < 0 ? -1 : 0; }
int syncfs(int fd) { return fd < 0 ? -1 : 0; }

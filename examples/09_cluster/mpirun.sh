#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sweep with MPI: each rank takes the next run when it has finished one.
#
#   mpirun.sh SUITE DIR N [mpirun's options, such as --hostfile hosts]
#
# In a Slurm job, `srun tagfield_sweep_mpi SUITE --out DIR` does the same if Slurm supports MPI.
set -euo pipefail
suite=$1
folder=$2
ranks=$3
shift 3
exec mpirun -np "$ranks" "$@" "${TAGFIELD_SWEEP_MPI:-tagfield_sweep_mpi}" "$suite" --out "$folder"

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A drive as a job array of Slurm: each task computes one part, and a second job merges them when all have ended well.
#   job=$(sbatch --parsable --array=0-15 configs/slurm.sh drive.toml out/drive)
#   sbatch --dependency=afterok:$job configs/slurm.sh merge out/drive
# All nodes must see both. Tasks share nothing else, so any number of them may run at a time, on any nodes. Of those that
# failed only these are started again, with the number of parts as the third word:
#   sbatch --array=3,7 configs/slurm.sh drive.toml out/drive 16
# `python3 -m wavetracer.distributed --slurm -c drive.toml -o out/drive --parts 16` submits both jobs.
#SBATCH --job-name=wavetracer
#SBATCH --gpus=1
#SBATCH --cpus-per-task=8
#SBATCH --time=04:00:00
#SBATCH --signal=B:INT@60
#SBATCH --requeue

if [ "$1" = merge ]; then
  exec wavetracer merge -o "$2" "$2"/parts/*
fi
# A minute before the time limit the part is interrupted (--signal); started again, it goes on where it was.
part=${SLURM_ARRAY_TASK_ID:?this script is for job arrays: sbatch --array=0-15 configs/slurm.sh CONFIG FOLDER}
parts=${3:-$SLURM_ARRAY_TASK_COUNT}
exec wavetracer run -c "$1" -o "$2/parts/$(printf '%05d_of_%05d' "$part" "$parts")" --shard "$part/$parts" --resume

//! Records of one adapter and one build, measured in several calls, as one.

use super::record::{Record, Run};

/// Joins records that differ in nothing but the scenes and counts that they measured, in their order,
/// and the names of their `files` with them: a sweep that was cut in pieces is one again. Records with a
/// scene at the same count in common are two measurements of it, and stay apart.
pub fn merged(records: Vec<Record>, files: Vec<String>) -> (Vec<Record>, Vec<String>) {
    let mut all: Vec<(Record, String)> = Vec::new();
    let mut files = files.into_iter();
    for record in records {
        let file = files.next().unwrap_or_default();
        let fits = |other: &&mut (Record, String)| is_continued(&other.0, &record);
        match all.iter_mut().find(fits) {
            Some((first, names)) => {
                if *names != file {
                    *names = format!("{names}, {file}");
                }
                join(first, record);
            }
            None => all.push((record, file)),
        }
    }
    all.into_iter().unzip()
}

/// Whether `next` goes on with what `first` began.
fn is_continued(first: &Record, next: &Record) -> bool {
    let of = |record: &Record| {
        let Record {
            motes,
            commit,
            adapter,
            driver,
            driver_version,
            backend,
            os,
            cpu,
            cpu_threads,
            options,
            ..
        } = record.clone();
        let versions = (motes, commit, driver, driver_version);
        (versions, adapter, backend, os, cpu, cpu_threads, options)
    };
    let is_in = |run: &Run, record: &Record| {
        let same = |it: &Run| it.scene == run.scene && it.particles == run.particles;
        record.runs.iter().any(same)
    };
    of(first) == of(next) && !next.runs.is_empty() && !next.runs.iter().any(|run| is_in(run, first))
}

/// Runs are added; of kernels alone, those that are not there yet.
fn join(first: &mut Record, next: Record) {
    first.runs.extend(next.runs);
    for measure in next.micro {
        if !first.micro.iter().any(|it| it.name == measure.name) {
            first.micro.push(measure);
        }
    }
    for warning in next.warnings {
        if !first.warnings.contains(&warning) {
            first.warnings.push(warning);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(commit: &str, counts: &[u64]) -> Record {
        let run = |particles: &u64| Run {
            scene: "million".into(),
            particles: *particles,
            ..Run::default()
        };
        Record {
            commit: Some(commit.into()),
            runs: counts.iter().map(run).collect(),
            warnings: vec!["debug".into()],
            ..Record::default()
        }
    }

    #[test]
    fn a_sweep_in_pieces_is_one_and_two_measurements_are_two() {
        let records = vec![
            record("a", &[1, 2]),
            record("b", &[3]),
            record("a", &[3]),
            record("a", &[2, 4]),
        ];
        let files = ["1", "2", "3", "4"].map(str::to_owned).to_vec();
        let (records, files) = merged(records, files);
        let counts =
            |record: &Record| -> Vec<u64> { record.runs.iter().map(|run| run.particles).collect() };
        let all: Vec<Vec<u64>> = records.iter().map(counts).collect();
        assert_eq!(all, [vec![1, 2, 3], vec![3], vec![2, 4]]);
        assert_eq!(files, ["1, 3", "2", "4"]);
        assert_eq!(records[0].warnings, ["debug"]);
    }
}

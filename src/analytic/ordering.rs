//! Which equations determine which unknowns: the block-triangular form of a sparse pattern.
//!
//! A maximum matching pairs equations with unknowns; the strongly connected parts of the paired graph
//! are the smallest groups that can be solved one after the other (Dulmage and Mendelsohn 1958; Tarjan
//! 1972). For a linkage these are its driver and its Assur groups, found without knowing them by name.

use std::collections::VecDeque;

/// A group of as many equations as unknowns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Group {
    /// Indices of the equations.
    pub(super) rows: Vec<usize>,
    /// Indices of the unknowns.
    pub(super) columns: Vec<usize>,
}

/// The order of solution.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Ordering {
    /// Groups, each depending only on those before it.
    pub(super) groups: Vec<Group>,
    /// Unknowns that the equations leave free, ascending.
    pub(super) free: Vec<usize>,
    /// Equations that are not needed.
    pub(super) spare: Vec<usize>,
}

const NONE: usize = usize::MAX;

/// Orders the equations; `pattern[row]` names the unknowns in it. Where there are more equations than
/// unknowns, the earlier ones are kept.
pub(super) fn order(pattern: &[Vec<usize>], unknowns: usize) -> Ordering {
    let mut row_of = vec![NONE; unknowns];
    let mut column_of = vec![NONE; pattern.len()];
    let mut reached_from = vec![NONE; unknowns];
    let mut reached = Vec::new();
    let mut queue = VecDeque::with_capacity(pattern.len());
    for row in 0..pattern.len() {
        reached.drain(..).for_each(|column: usize| reached_from[column] = NONE);
        queue.clear();
        queue.push_back(row);
        augment(pattern, &mut row_of, &mut column_of, (&mut reached_from, &mut reached), &mut queue);
    }

    let mut users = vec![Vec::new(); unknowns];
    for (row, columns) in pattern.iter().enumerate() {
        for column in columns {
            users[*column].push(row);
        }
    }
    let mut free = vec![false; unknowns];
    let mut queue: VecDeque<usize> = (0..unknowns).filter(|c| row_of[*c] == NONE).collect();
    queue.iter().for_each(|c| free[*c] = true);
    while let Some(column) = queue.pop_front() {
        for row in &users[column] {
            let other = column_of[*row];
            if other != NONE && !free[other] {
                free[other] = true;
                queue.push_back(other);
            }
        }
    }

    let groups = components(pattern, &row_of, &free)
        .into_iter()
        .map(|mut columns| {
            columns.sort_unstable();
            let mut rows: Vec<usize> = columns.iter().map(|c| row_of[*c]).collect();
            rows.sort_unstable();
            Group { rows, columns }
        })
        .collect();
    Ordering {
        groups,
        free: (0..unknowns).filter(|c| free[*c]).collect(),
        spare: (0..pattern.len()).filter(|r| column_of[*r] == NONE).collect(),
    }
}

/// What the wanted unknowns depend on: they themselves, what is solved with them, and the unknowns of the equations that
/// solve them, and so on. `wanted` and the answer are by unknown.
pub(super) fn needed(ordering: &Ordering, pattern: &[Vec<usize>], wanted: &[bool]) -> Vec<bool> {
    let mut group_of = vec![NONE; wanted.len()];
    for (index, group) in ordering.groups.iter().enumerate() {
        group.columns.iter().for_each(|column| group_of[*column] = index);
    }
    let mut needed = wanted.to_vec();
    let mut done = vec![false; ordering.groups.len()];
    let mut waiting: Vec<usize> = (0..wanted.len()).filter(|column| wanted[*column]).collect();
    while let Some(column) = waiting.pop() {
        let Some(group) = ordering.groups.get(group_of[column]) else { continue };
        if std::mem::replace(&mut done[group_of[column]], true) {
            continue;
        }
        let bound = group.rows.iter().flat_map(|row| &pattern[*row]).chain(&group.columns);
        for &other in bound {
            if !std::mem::replace(&mut needed[other], true) {
                waiting.push(other);
            }
        }
    }
    needed
}

/// Pairs one more row, which stands in the queue, along a shortest alternating path, if there is one. No column has
/// been reached; those that are, are listed.
fn augment(
    pattern: &[Vec<usize>],
    row_of: &mut [usize],
    column_of: &mut [usize],
    (reached_from, reached): (&mut [usize], &mut Vec<usize>),
    queue: &mut VecDeque<usize>,
) {
    while let Some(from) = queue.pop_front() {
        for &column in &pattern[from] {
            if reached_from[column] != NONE {
                continue;
            }
            reached_from[column] = from;
            reached.push(column);
            if row_of[column] != NONE {
                queue.push_back(row_of[column]);
                continue;
            }
            let mut column = column;
            while column != NONE {
                let taker = reached_from[column];
                let left = column_of[taker];
                row_of[column] = taker;
                column_of[taker] = column;
                column = left;
            }
            return;
        }
    }
}

/// Strongly connected components of the columns, dependencies first (Tarjan, without recursion).
fn components(pattern: &[Vec<usize>], row_of: &[usize], free: &[bool]) -> Vec<Vec<usize>> {
    let count = row_of.len();
    let mut index = vec![NONE; count];
    let mut low = vec![0; count];
    let mut on_stack = vec![false; count];
    let mut stack = Vec::with_capacity(count);
    let mut work = Vec::with_capacity(count);
    let mut found = Vec::with_capacity(count);
    let mut next = 0;
    for root in (0..count).filter(|c| !free[*c]) {
        if index[root] != NONE {
            continue;
        }
        work.push((root, 0));
        while let Some(&mut (column, ref mut edge)) = work.last_mut() {
            if *edge == 0 {
                index[column] = next;
                low[column] = next;
                next += 1;
                stack.push(column);
                on_stack[column] = true;
            }
            let needs = &pattern[row_of[column]];
            if let Some(&needed) = needs.get(*edge) {
                *edge += 1;
                if free[needed] {
                    continue;
                }
                if index[needed] == NONE {
                    work.push((needed, 0));
                } else if on_stack[needed] {
                    low[column] = low[column].min(index[needed]);
                }
                continue;
            }
            work.pop();
            if let Some(&(parent, _)) = work.last() {
                low[parent] = low[parent].min(low[column]);
            }
            if low[column] == index[column] {
                let mut component = Vec::new();
                while let Some(member) = stack.pop() {
                    on_stack[member] = false;
                    component.push(member);
                    if member == column {
                        break;
                    }
                }
                found.push(component);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangular_system_is_solved_one_by_one() {
        let ordering = order(&[vec![0, 1, 2], vec![0], vec![0, 1]], 3);
        let columns: Vec<_> = ordering.groups.iter().map(|g| g.columns.clone()).collect();
        assert_eq!(columns, [[0], [1], [2]]);
        assert!(ordering.free.is_empty() && ordering.spare.is_empty());
    }

    #[test]
    fn a_loop_is_one_group_and_a_missing_equation_frees_only_what_it_feeds() {
        let ordering = order(&[vec![0], vec![0, 1, 2], vec![1, 2], vec![2, 3, 4], vec![0]], 5);
        assert_eq!(ordering.groups[1].columns, [1, 2]);
        assert_eq!(ordering.free, [3, 4]);
        assert_eq!(ordering.spare, [4]);
    }
}
